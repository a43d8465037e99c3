// Animation times and the packing of poses.
#include "scene/assets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "scene/animation.h"
#include "shared/packing.h"

namespace fb::scene {
namespace {

Material animated(std::size_t frames, std::size_t alternates) {
  Material material;
  for (std::uint32_t i = 0; i < frames; ++i) material.frames.push_back({i, kNone, kNone, kNone});
  for (std::uint32_t i = 0; i < alternates; ++i) material.alternate_frames.push_back({100 + i, kNone, kNone, kNone});
  return material;
}

TEST(Animation, TexturesPlayAsInQuake) {
  const Material material = animated(3, 2);
  // Quake: frame = int(time * 10) mod (2 * frames) / 2.
  for (int tenth = 0; tenth < 50; ++tenth) {
    const double time = tenth / 10.0 + 0.05;
    EXPECT_EQ(texture_at(material, time, false).base, static_cast<std::uint32_t>(tenth % 6 / 2)) << time;
    EXPECT_EQ(texture_at(material, time, true).base, static_cast<std::uint32_t>(100 + tenth % 4 / 2)) << time;
  }
  EXPECT_EQ(texture_at(material, -0.1, false).base, 2u) << "before time zero it still turns";
  EXPECT_EQ(texture_at(animated(2, 0), 0.25, true).base, 1u) << "no alternates: the same";
  EXPECT_EQ(texture_at(Material(), 1.0, false).base, kNone);
  EXPECT_EQ(texture_at(animated(4, 0), 1e18, false).base < 4u, true);
  EXPECT_EQ(texture_at(animated(4, 0), std::nan(""), false).base, 0u);
}

TEST(Animation, GroupsPlayByTheirEndTimes) {
  const std::vector<float> ends{0.1f, 0.4f, 0.5f};
  const std::pair<double, std::size_t> expected[] = {{0.0, 0},  {0.05, 0}, {0.11, 1},  {0.39, 1}, {0.45, 2},
                                                     {0.55, 0}, {0.75, 1}, {-0.05, 2}, {50.45, 2}};
  for (const auto& [time, index] : expected) EXPECT_EQ(frame_of_group(ends, 3, time), index) << time;
  EXPECT_EQ(frame_of_group({}, 3, 5.0), 0u);
  EXPECT_EQ(frame_of_group({0.0f, 0.0f}, 2, 5.0), 0u) << "a period of nothing";
  Material material = animated(3, 0);
  material.end_times = ends;
  EXPECT_EQ(texture_at(material, 0.2, false).base, 1u);
}

TEST(PoseVertex, KeepsItsNormal) {
  for (const vec3& n : {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0), vec3(-0.6f, 0.64f, -0.48f)}) {
    const PoseVertex v = make_pose_vertex(1, 2, 255, n);
    EXPECT_EQ(pose_numbers(v), vec3(1, 2, 255));
    const std::uint32_t packed = static_cast<std::uint16_t>(v.normal_u) |
                                 static_cast<std::uint32_t>(static_cast<std::uint16_t>(v.normal_v)) << 16u;
    EXPECT_NEAR(glm::length(shared::unpack_direction(packed) - n), 0.0f, 1e-4f);
  }
}

}  // namespace
}  // namespace fb::scene
