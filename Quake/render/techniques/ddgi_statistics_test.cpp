// How far probes are off: held to the path tracer with stated tolerances, and to closed forms of one lamp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/test_device.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_of_rooms.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scene_of_kinds.h"

namespace fb::render {
namespace {

using DdgiStatistics = DeviceTest;

RenderSettings bias_settings(const std::string& estimator, int bounces) {
  RenderSettings s;
  s.intersector = Intersector::kBvh;
  s.estimator = estimator;
  s.bounces = bounces;
  s.spp = 4;
  s.jitter = 0;
  return s;
}

// The mean luminance of what frames' means are, and its standard error over frames.
struct FrameMeans {
  double mean = 0, error = 0;
};
FrameMeans means_of(Renderer& renderer, const scene::FrameSnapshot& scene, RenderSettings s, int warm, int frames) {
  s.accumulate = 0;
  for (int i = 0; i < warm; ++i) renderer.render(scene, nullptr, s);
  double sum = 0, square = 0;
  for (int i = 0; i < frames; ++i) {
    renderer.render(scene, nullptr, s);
    double m = 0;
    const std::vector<vec4> image = renderer.read().linear();
    for (const vec4& p : image) m += static_cast<double>(p.y) / static_cast<double>(image.size());
    sum += m / frames;
    square += m * m / frames;
  }
  EXPECT_EQ(renderer.read().counters().not_finite, 0u);
  return {sum, std::sqrt(std::max(square - sum * sum, 0.0) / (frames - 1))};
}

// Within so much of all reflections of a Cornell box, and of what two reflections are less than all.
TEST_F(DdgiStatistics, ACornellBoxIsNearAllReflections) {
  const scene::FrameSnapshot box = scene::cornell_box();
  RenderSettings all = bias_settings("nee", 16);
  all.spp = 32;
  auto reference = make_renderer(all, 40, 40);
  const FrameMeans truth = means_of(*reference, box, all, 2, 8);
  struct Case {
    const char* name;
    double most;  // bias, relative
  };
  for (const Case& c : {Case{"ddgi", 0.08}, Case{"ddgi_plus", 0.05}, Case{"ddgi_restir", 0.05}}) {
    const RenderSettings s = bias_settings(c.name, 3);
    auto renderer = make_renderer(s, 40, 40);
    const FrameMeans found = means_of(*renderer, box, s, 40, 16);
    const double bias = found.mean / truth.mean - 1, error = std::hypot(found.error, truth.error) / truth.mean;
    RecordProperty(c.name, std::to_string(bias) + " +- " + std::to_string(1.96 * error));
    EXPECT_LT(std::abs(bias), c.most + 3 * error) << c.name;
    EXPECT_LT(error, 0.01) << c.name << ": the test can see little";
  }
}

// A control variate and a guide change a picture's noise, not its mean: the same probes' light as without.
TEST_F(DdgiStatistics, AControlVariateAndAGuideLeaveTheMean) {
  const std::pair<const char*, scene::FrameSnapshot> scenes[] = {{"box", scene::cornell_box()},
                                                                 {"kinds", scene::light_of_every_kind()}};
  for (const auto& [name, snapshot] : scenes) {
    FrameMeans plain;
    for (const auto& [control, guide] :
         {std::pair(0, 0.0f), std::pair(1, 0.0f), std::pair(0, 0.5f), std::pair(1, 0.95f)}) {
      RenderSettings s = bias_settings("ddgi_plus", 3);
      s.ddgi_control = control;
      s.ddgi_guide = guide;
      auto renderer = make_renderer(s, 40, 40);
      const FrameMeans found = means_of(*renderer, snapshot, s, 40, 16);
      if (control == 0 && guide == 0) plain = found;
      const double off = found.mean / plain.mean - 1, error = std::hypot(found.error, plain.error) / plain.mean;
      RecordProperty(std::string(name) + " control " + std::to_string(control) + " guide " + std::to_string(guide),
                     std::to_string(off) + " +- " + std::to_string(1.96 * error));
      EXPECT_LT(std::abs(off), 4 * error + 0.002) << name << " " << control << " " << guide;
      EXPECT_LT(error, 0.01) << name << ": the test can see little";
    }
  }
}

// A sphere over a floor of little albedo. Seven probes above each other stand half a cell off the floor, where the lamp
// is nearer: its light is that of the inverse square of the distance there. Attenuated further by the way to the floor
// (Section 3.3) it is the floor's own.
TEST_F(DdgiStatistics, OneLampLightsAPlane) {
  constexpr float kRadius = 8, kRadiance = 100, kAlbedo = 0.1f;
  scene::FrameSnapshot room = scene::one_light(kRadius, kRadiance, kAlbedo);
  room.camera.position = vec3(0, 0, -100);
  room.camera.angles = vec3(90, 0, 0);
  room.camera.fov_x = 40;
  room.prev_camera = room.camera;
  const double expected = static_cast<double>(kAlbedo * kRadiance) * std::pow(static_cast<double>(kRadius) / 128, 2);
  double found[2] = {};
  for (const int attenuated : {0, 1}) {
    RenderSettings s = bias_settings("ddgi_plus", 2);
    s.ddgi_vertex = 1;
    s.ddgi_spacing = 40;
    s.ddgi_attenuation = static_cast<float>(attenuated);
    s.ddgi_rays = 65536;
    auto renderer = make_renderer(s, 24, 24);
    found[attenuated] = means_of(*renderer, room, s, 40, 4).mean;
  }
  const double nearer = 128 - 256.0 / 7 / 2;
  RecordProperty("too bright", std::to_string(found[0] / expected));
  RecordProperty("attenuated", std::to_string(found[1] / expected));
  EXPECT_NEAR(found[0] / expected, 128 * 128 / (nearer * nearer), 0.06);
  EXPECT_NEAR(found[1] / expected, 1, 0.06);
}

// What is bright in the dark one of two rooms has leaked: the mean of what it is in the lit one.
struct LeakCase {
  const char* name;
  const char* estimator;
  int visibility, leaves;
};
double leak_of(Renderer& renderer, const LeakCase& c, const scene::FrameSnapshot& rooms) {
  RenderSettings s = bias_settings(c.estimator, 3);
  s.ddgi_visibility = c.visibility;
  s.ddgi_leaves = c.leaves;
  s.ddgi_rays = 65536;
  const auto seen_from = [&](float x) {
    scene::FrameSnapshot seen = rooms;
    seen.camera = seen.prev_camera = scene::camera_at({x, -60, 80}, {10, 0, 0}, 90);
    return seen;
  };
  const double lit = means_of(renderer, seen_from(20), s, 24, 2).mean;
  return means_of(renderer, seen_from(-220), s, 8, 2).mean / lit;
}

// Through a wall of one unit. Probes that ask whether they see a point leak less than those that do not, and what leaks
// lies one reflection further away in ddgi_plus. Where the map's leafs say who asks whom nothing leaks at all, even
// though nobody asks whether a probe sees a point.
TEST_F(DdgiStatistics, AThinWallLeaksWithTheGridAndNotWithLeaves) {
  const LeakCase cases[] = {{"no visibility", "ddgi", 0, 0},
                            {"ddgi", "ddgi", 1, 0},
                            {"ddgi_plus", "ddgi_plus", 1, 0},
                            {"leaves, no visibility", "ddgi", 0, 1},
                            {"leaves, ddgi_plus", "ddgi_plus", 1, 1}};
  std::vector<double> leaks;
  auto renderer = make_renderer(bias_settings("ddgi", 3), 32, 24);
  for (const LeakCase& c : cases) {
    leaks.push_back(leak_of(*renderer, c, scene::thin_wall(false)));
    RecordProperty(c.name, std::to_string(leaks.back()));
  }
  EXPECT_GT(leaks[0], 0.01);
  EXPECT_LT(leaks[1], 0.3 * leaks[0]);
  EXPECT_LT(leaks[2], 0.3 * leaks[0]);
  EXPECT_GT(leaks[1], 0);
  EXPECT_GT(leaks[2], 0);
  EXPECT_EQ(leaks[3], 0);
  EXPECT_EQ(leaks[4], 0);
}

// A closed door lies in leafs that are open: its box shuts off the probes behind it.
TEST_F(DdgiStatistics, NothingLeaksThroughAClosedDoor) {
  auto renderer = make_renderer(bias_settings("ddgi", 3), 32, 24);
  const double grid = leak_of(*renderer, {"grid", "ddgi", 0, 0}, scene::split_room(true));
  const double leaves = leak_of(*renderer, {"leaves", "ddgi", 0, 1}, scene::split_room(true));
  const double open = leak_of(*renderer, {"open", "ddgi", 0, 1}, scene::split_room(false));
  RecordProperty("grid", std::to_string(grid));
  RecordProperty("leaves", std::to_string(leaves));
  EXPECT_GT(grid, 0.001);
  EXPECT_EQ(leaves, 0);
  EXPECT_GT(open, 0.001) << "light comes through the doorway";
}

}  // namespace
}  // namespace fb::render
