// r_intersector auto: what is measured, and that it is what the renderer takes.
#include "render/scene/intersector_choice.h"

#include <gtest/gtest.h>

#include "render/test_device.h"

namespace fb::render {
namespace {

using IntersectorChoiceTest = DeviceTest;

TEST_F(IntersectorChoiceTest, TakesTheFasterOne) {
  RenderSettings s;
  s.intersector = Intersector::kAuto;
  if (!device_->has_ray_query()) {
    EXPECT_EQ(make_renderer(s, 8, 8)->intersector_name(), "bvh");
    return;
  }
  const IntersectorSpeeds speeds = measure_intersectors(*device_, std::nullopt);
  EXPECT_GT(speeds.query, 0.0);
  EXPECT_GT(speeds.bvh, 0.0);
  const bool query = ray_query_is_faster(*device_, std::nullopt);
  EXPECT_EQ(make_renderer(s, 8, 8)->intersector_name(), query ? "query" : "bvh");
  // Two measurements may differ where both are about as fast.
  if (speeds.query > 2 * speeds.bvh) {
    EXPECT_TRUE(query);
  }
  if (speeds.bvh > 2 * speeds.query) {
    EXPECT_FALSE(query);
  }
}

}  // namespace
}  // namespace fb::render
