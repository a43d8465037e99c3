#include "gpu/device_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace fb::gpu {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;

DeviceReport made_up(std::string name, std::string type, bool usable = true) {
  DeviceReport report;
  report.name = std::move(name);
  report.type = std::move(type);
  report.usable = usable;
  if (!usable) report.lacks.push_back("Vulkan 1.1 only, 1.2 is needed: unusable");
  return report;
}

const DeviceReport kReports[] = {made_up("llvmpipe (LLVM 15)", "cpu"), made_up("Intel UHD", "integrated"),
                                 made_up("Radeon RX", "discrete"), made_up("GeForce GT", "discrete", false),
                                 made_up("Radeon Pro", "discrete")};

TEST(ChooseDevice, TakesTheBestUsableKindAndTheFirstOfEquals) {
  EXPECT_EQ(*choose_device(kReports, ""), 2u);
  EXPECT_EQ(*choose_device(std::span(kReports).first(2), ""), 1u);
}

TEST(ChooseDevice, FindsNamesWhateverTheCaseAndIndices) {
  EXPECT_EQ(*choose_device(kReports, "LLVMpipe"), 0u);
  EXPECT_EQ(*choose_device(kReports, "radeon p"), 4u);
  EXPECT_EQ(*choose_device(kReports, "1"), 1u);
}

TEST(ChooseDevice, SaysWhyNot) {
  const auto unknown = choose_device(kReports, "Voodoo");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("Voodoo"));
  EXPECT_THAT(unknown.error().message, HasSubstr("Intel UHD"));
  const auto refused = choose_device(kReports, "3");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("Vulkan 1.1 only"));
  EXPECT_FALSE(choose_device(kReports, "5"));
  EXPECT_THAT(choose_device({}, "").error().message, HasSubstr("mesa-vulkan-drivers"));
}

TEST(ListDevices, SaysWhatEachLacksAndChoosesOne) {
  const auto list = list_devices({});
  if (!list) GTEST_SKIP() << "no Vulkan device: " << list.error().message;
  int chosen = 0;
  for (const DeviceReport& report : *list) {
    EXPECT_FALSE(report.name.empty());
    EXPECT_FALSE(report.driver.empty());
    EXPECT_THAT(report.type, AnyOf("discrete", "integrated", "virtual", "cpu", "other"));
    chosen += report.would_be_chosen;
    const auto says = [&](const char* what) { return testing::Matches(Contains(HasSubstr(what)))(report.lacks); };
    EXPECT_EQ(report.usable, !says(": unusable")) << report.name;
    EXPECT_EQ(report.is_software, says("no graphics hardware")) << report.name;
    if (report.usable) {
      EXPECT_EQ(report.has_ray_query, !says("rays are traced by the BVH in the compute shader")) << report.name;
    }
  }
  EXPECT_LE(chosen, 1);
}

TEST(ListDevices, SpeaksOfLavapipe) {
  DeviceOptions options;
  options.preferred = "llvmpipe";
  const auto list = list_devices(options);
  if (!list) GTEST_SKIP() << "no Vulkan device: " << list.error().message;
  for (const DeviceReport& report : *list) {
    if (report.name.find("llvmpipe") == std::string::npos) continue;
    EXPECT_EQ(report.type, "cpu");
    EXPECT_TRUE(report.is_software);
    EXPECT_TRUE(report.usable);
    EXPECT_THAT(report.driver, HasSubstr("llvmpipe"));
    return;
  }
  GTEST_SKIP() << "lavapipe is not installed";
}

// The loader finds no driver where it is pointed at none.
TEST(ListDevices, WithoutADriverSaysWhatToInstall) {
  const auto keep = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
  const std::string icd = keep("VK_ICD_FILENAMES"), driver = keep("VK_DRIVER_FILES");
  setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1);
  setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
  const auto list = list_devices({});
  icd.empty() ? unsetenv("VK_ICD_FILENAMES") : setenv("VK_ICD_FILENAMES", icd.c_str(), 1);
  driver.empty() ? unsetenv("VK_DRIVER_FILES") : setenv("VK_DRIVER_FILES", driver.c_str(), 1);
  ASSERT_FALSE(list);
  EXPECT_THAT(list.error().message, HasSubstr("mesa-vulkan-drivers"));
}

TEST(Device, NeedsTheExtensionsAskedFor) {
  DeviceOptions options;
  options.instance_extensions = {"VK_FB_no_such_extension"};
  const auto made = Device::create(options);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message, HasSubstr("VK_FB_no_such_extension"));
}

}  // namespace
}  // namespace fb::gpu
