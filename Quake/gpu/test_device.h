// The device of this module's tests: validated, one a test suite; skipped, saying so, where there is none.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "gpu/device.h"

namespace fb::gpu {

class DeviceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    DeviceOptions options;
    options.validation = true;
    options.synchronization_validation = true;
    auto made = Device::create(options);
    if (made)
      device_ = std::move(*made);
    else
      why_not_ = made.error().message;
  }
  static void TearDownTestSuite() { device_.reset(); }
  void SetUp() override {
    if (!device_) GTEST_SKIP() << "no Vulkan device: " << why_not_;
    messages_before_ = device_->validation_messages();
  }
  void TearDown() override {
    if (!device_) return;
    EXPECT_EQ(device_->validation_messages(), messages_before_) << "the validation layers spoke";
  }

  inline static std::unique_ptr<Device> device_;
  inline static std::string why_not_;
  std::uint64_t messages_before_ = 0;
};

}  // namespace fb::gpu
