// The device that drawing tests share: validation layers on, skipped (saying so) where there is no Vulkan device.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "render/renderer.h"

namespace fb::render {

class DeviceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    gpu::DeviceOptions options;
    options.validation = true;
    auto made = gpu::Device::create(options);
    if (made)
      device_ = std::move(*made);
    else
      why_not_ = made.error().message;
  }
  static void TearDownTestSuite() { device_.reset(); }
  void SetUp() override {
    if (!device_) {
      GTEST_SKIP() << "no Vulkan device: " << why_not_;
    }
  }
  void TearDown() override {
    if (device_) {
      EXPECT_EQ(device_->validation_messages(), 0u);
    }
  }

  static void render_still(Renderer& renderer, const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                           int frames) {
    for (int i = 0; i < frames; ++i) renderer.render(snapshot, nullptr, settings);
  }

  static std::unique_ptr<Renderer> make_renderer(const RenderSettings& settings, std::uint32_t width,
                                                 std::uint32_t height) {
    auto renderer = Renderer::create(*device_, settings);
    if (!renderer) {
      ADD_FAILURE() << renderer.error().message;
      return nullptr;
    }
    (*renderer)->resize(width, height);
    return std::move(*renderer);
  }
  // For light whose value is known: rays by our own traversal through the pixels' middles, level water.
  static RenderSettings plain_settings(const std::string& estimator, int bounces) {
    RenderSettings s;
    s.intersector = Intersector::kBvh;
    s.estimator = estimator;
    s.bounces = bounces;
    s.water_waves = 0;
    s.jitter = 0;
    return s;
  }
  // The intersectors that this device offers.
  static std::vector<Intersector> intersectors() {
    std::vector<Intersector> list{Intersector::kBvh};
    if (device_->has_ray_query()) list.push_back(Intersector::kQuery);
    return list;
  }

  inline static std::unique_ptr<gpu::Device> device_;
  inline static std::string why_not_;
};

}  // namespace fb::render
