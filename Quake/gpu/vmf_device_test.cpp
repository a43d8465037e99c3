// shared/vmf.h through the shader, held to what Vulkan promises of float32 and of exp and log.
#include "gpu/test_device.h"
#include "gpu/test_vmf_device.h"
#include "shared/test_vmf_checks.h"

namespace fb::gpu {
namespace {

class VmfDeviceTest : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (device_) vmf_ = std::make_unique<VmfDevice>(*device_);
  }
  void TearDown() override {
    vmf_.reset();
    DeviceTest::TearDown();
  }
  std::unique_ptr<VmfDevice> vmf_;
};

TEST_F(VmfDeviceTest, IsWithinItsErrorBounds) {
  shared::check_vmf_errors(std::ref(*vmf_), shared::kVmfVulkanPrecision);
}
TEST_F(VmfDeviceTest, KappaAndMeanCosineInvertEachOther) {
  shared::check_vmf_inversion(std::ref(*vmf_), shared::kVmfVulkanPrecision);
}
TEST_F(VmfDeviceTest, IsFiniteEverywhere) { shared::check_vmf_is_finite(std::ref(*vmf_)); }
TEST_F(VmfDeviceTest, SamplerFollowsThePdf) { shared::check_vmf_sampler_follows_pdf(std::ref(*vmf_)); }

}  // namespace
}  // namespace fb::gpu
