// What tests of reservoirs share.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "render/test_device.h"
#include "render/test_means.h"

namespace fb::render {

class RestirTest : public DeviceTest {
 public:
  static RenderSettings reuse_settings(int bounces, const std::string& estimator = "restir_di") {
    RenderSettings s;
    s.estimator = estimator;
    s.bounces = bounces;
    s.accumulate = 0;
    return s;
  }
};

}  // namespace fb::render
