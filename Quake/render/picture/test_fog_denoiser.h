// What tests of fog in the denoised picture share.
#pragma once

#include <gtest/gtest.h>

#include "render/test_denoiser.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {

class FogDenoiserTest : public DeviceTest {
 protected:
  // The same assets always.
  static const scene::FrameSnapshot& clear_box() {
    static const scene::FrameSnapshot snapshot = scene::cornell_box();
    return snapshot;
  }
  static scene::FrameSnapshot foggy_box() {
    scene::FrameSnapshot snapshot = clear_box();
    snapshot.medium = {1.0f / 900, vec3(0.9f, 0.8f, 0.7f), 0.3f, 0.0f, 1.0f};
    return snapshot;
  }
  static RenderSettings denoising_fog(float light_scale, float fog_scale) {
    RenderSettings s = denoising();
    s.estimator = "nee";
    s.jitter = 0;
    s.light_scale = light_scale;
    s.fog_scale = fog_scale;
    return s;
  }
};

}  // namespace fb::render
