#include "host/game/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "render/passes/settings.h"

namespace fb::host {
namespace {

class PresetsTest : public testing::Test {
 protected:
  PresetsTest() {
    render::register_render_cvars(console);
    console.add_cvar("r_target_ms", "-1", "");
    console.add_cvar("r_cpu_pixels", "129600", "");
    register_presets(console, [this] { ++measurements; });
  }
  con::Console console;
  int measurements = 0;
};

TEST_F(PresetsTest, EachIsInForceOnceItIsChosenAndNoLongerWhenASettingChanges) {
  EXPECT_EQ(preset_in_force(console), nullptr);
  EXPECT_TRUE(presets_untouched(console));
  for (const Preset& preset : presets()) {
    console.execute(std::string("preset ") + preset.name);
    ASSERT_NE(preset_in_force(console), nullptr) << preset.name << ": a cvar does not take its value";
    EXPECT_STREQ(preset_in_force(console)->name, preset.name);
    EXPECT_EQ(console.cvar("r_preset").string(), preset.name);
    EXPECT_FALSE(presets_untouched(console));
  }
  console.execute("r_spp 3");
  EXPECT_EQ(preset_in_force(console), nullptr);
}

TEST_F(PresetsTest, AnUnknownOneChangesNothing) {
  console.execute("preset splendid");
  EXPECT_TRUE(presets_untouched(console));
  console.execute("preset auto");
  EXPECT_EQ(measurements, 1);
}

TEST(PresetFor, AWindowAndADeviceHaveTheLastThatIsDrawnAsItIsMeant) {
  const uvec2 hd(1280, 720), uhd(3840, 2160);
  const auto name = [](double speed, uvec2 window) { return std::string(preset_for(speed, window).name); };
  EXPECT_EQ(name(100, hd), "potato");
  EXPECT_EQ(name(299, hd), "potato");
  EXPECT_EQ(name(301, hd), "lavapipe") << "30000 pixels in 100 ms";
  EXPECT_EQ(name(14000, hd), "lavapipe");
  EXPECT_EQ(name(15000, hd), "balanced") << "a quarter of 1280x720 in 16 ms";
  EXPECT_EQ(name(15000, uhd), "lavapipe");
  EXPECT_EQ(name(1e6, uhd), "beautiful") << "the reference is chosen by hand alone";
}

TEST(DeviceSpeed, IsTheMedianOfTwoSecondsWithoutTheFirstFrames) {
  const Preset& lavapipe = *find_preset("lavapipe");
  DeviceSpeed speed;
  double now = 5.0;
  for (int i = 0; i < 8; ++i) speed.add(lavapipe, 100000.0, 1000.0, now += 1.0);
  EXPECT_FALSE(speed.measured()) << "pipelines are made";
  for (int i = 0; i < 19; ++i) speed.add(lavapipe, 100000.0, i % 4 == 0 ? 400.0 : 100.0, now += 0.1);
  EXPECT_FALSE(speed.measured()) << "1.9 seconds";
  for (int i = 0; i < 12; ++i) speed.add(lavapipe, 100000.0, 100.0, now += 0.1);
  ASSERT_TRUE(speed.measured());
  EXPECT_DOUBLE_EQ(*speed.measured(), 1000.0);
}

TEST(DeviceSpeed, ASlowDeviceHasFiveFramesAtLeast) {
  DeviceSpeed speed;
  double now = 0.0;
  for (int i = 0; i < 8 + 4; ++i) speed.add(*find_preset("lavapipe"), 1000.0, 4000.0, now += 4.0);
  EXPECT_FALSE(speed.measured());
  speed.add(*find_preset("lavapipe"), 1000.0, 4000.0, now += 4.0);
  EXPECT_TRUE(speed.measured());
}

}  // namespace
}  // namespace fb::host
