// What tests of the memory of shadow rays share.
#pragma once

#include <gtest/gtest.h>

#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {

class SeenGridTest : public DeviceTest {
 protected:
  static RenderSettings looking(int seed) {
    RenderSettings s;
    s.estimator = "nee";
    s.spp = 4;
    s.accumulate = 0;
    s.jitter = 0;
    s.seed = seed;
    return s;
  }
  // A room with a lamp; its sun would outshine it, and no sky shows it.
  static scene::FrameSnapshot room_without_view() {
    scene::FrameSnapshot snapshot = scene::cornell_box();
    snapshot.sky.suns = {{glm::normalize(vec3(0.2f, 0.3f, 0.9f)), vec3(100), 1.0f}};
    return snapshot;
  }
};

}  // namespace fb::render
