// What tests of light at one pixel of a block share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "render/test_denoiser.h"

namespace fb::render {

class LightScaleTest : public DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 71, kHeight = 41;  // blocks at the edges are not whole

  static RenderSettings scaled(float scale) {
    RenderSettings s = denoising();
    s.light_scale = scale;
    return s;
  }
};

}  // namespace fb::render
