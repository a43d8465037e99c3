// Technique mir, in small: pictures whose size changes under way, and the densities that `mir_nee` stores.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "render/techniques/guiding_trees.h"
#include "render/techniques/iteration_state.h"
#include "render/techniques/outlier_removal.h"
#include "render/techniques/path_store.h"
#include "render/test_device.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

constexpr float kHalfRoom = 128;

// A box that glows.
struct Lamp {
  vec3 low, high;
  float radiance;
  double power() const {
    const glm::dvec3 s(high - low);
    return 2 * (s.x * s.y + s.y * s.z + s.z * s.x) * static_cast<double>(radiance);
  }
};
constexpr Lamp kLamps[]{{{-60, 20, 40}, {-20, 80, 60}, 4}, {{30, -90, -70}, {80, -30, -60}, 1}};

scene::FrameSnapshot room_of_two_lamps() {
  auto assets = scene::new_code_assets();
  const std::uint32_t walls = scene::add_material(*assets, "walls", vec3(0.6f));
  const std::uint32_t light = scene::add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  scene::Mesh room, box;
  scene::add_box(room, vec3(-kHalfRoom), vec3(kHalfRoom), walls, true);
  scene::add_box(box, vec3(0.0f), vec3(1.0f), 0);  // `light`, by the instance
  const std::uint32_t room_mesh = scene::add_finished(*assets, std::move(room), "room");
  const std::uint32_t box_mesh = scene::add_finished(*assets, std::move(box), "box");
  scene::FrameSnapshot snapshot = scene::still(assets, scene::camera_at({-120, 0, 0}, {0, 0, 0}, 90.0f));
  snapshot.instances.push_back(scene::make_instance(scene::kIdWorld, room_mesh));
  std::uint32_t id = scene::kIdEntityLight;
  for (const Lamp& lamp : kLamps)
    snapshot.instances.push_back(
        scene::glowing(id++, box_mesh, light, lamp.low, lamp.high - lamp.low, vec3(lamp.radiance)));
  return snapshot;
}

class Mir : public DeviceTest {
 protected:
  static RenderSettings settings_of(const std::string& estimator) {
    RenderSettings settings;
    settings.estimator = estimator;
    settings.jitter = 0;
    settings.bounces = 3;
    settings.deterministic = 1;
    settings.accumulate = 1;
    settings.spp = 1;
    settings.mir_split = 50;  // so that a small picture has leaves
    return settings;
  }
  // One more sample a pixel.
  static void sample(Renderer& renderer, scene::FrameSnapshot& snapshot, const RenderSettings& settings) {
    renderer.restart_accumulation();
    renderer.render(snapshot, nullptr, settings);
    snapshot.cut = false;
    ++snapshot.frame;
  }
  static std::vector<vec4> picture(Renderer& renderer, const scene::FrameSnapshot& snapshot,
                                   const RenderSettings& settings) {
    renderer.end_iterations();
    renderer.render(snapshot, nullptr, settings);
    return renderer.read().linear();
  }
};

// What was seen in another size is forgotten, and what is left of the iteration is the first of the new picture: a
// size may change between an iteration's frames, between iterations, and before the picture is shown.
TEST_F(Mir, APictureOfAnotherSizeBeginsAnew) {
  for (const char* estimator : {"mir", "mir_nee"}) {
    const RenderSettings settings = settings_of(estimator);
    const auto whole = make_renderer(settings, 24, 16), changed = make_renderer(settings, 32, 24);
    // `before` samples of the larger picture, of iterations of four; then the smaller one.
    const auto run = [&](Renderer& renderer, std::uint32_t before) {
      renderer.reset_learning();
      scene::FrameSnapshot snapshot = room_of_two_lamps();
      renderer.resize(32, 24);
      for (std::uint32_t k = 0; k < before; ++k) {
        if (k % 4 == 0) renderer.begin_iteration(k / 4, 4);
        sample(renderer, snapshot, settings);
      }
      snapshot.frame = 100;
      snapshot.cut = true;
      std::uint32_t iteration = before / 4;
      if (before % 4 == 0) renderer.begin_iteration(iteration, 2);
      renderer.resize(24, 16);
      for (int k = 0; k < 2; ++k) sample(renderer, snapshot, settings);
      renderer.begin_iteration(++iteration, 3);
      for (int k = 0; k < 3; ++k) sample(renderer, snapshot, settings);
      return picture(renderer, snapshot, settings);
    };
    const std::vector<vec4> expected = run(*whole, 0);
    EXPECT_EQ(run(*changed, 2), expected) << estimator << ": within an iteration";
    EXPECT_EQ(run(*changed, 8), expected) << estimator << ": between two";
    // No sample was seen in the size that is shown.
    scene::FrameSnapshot snapshot = room_of_two_lamps();
    changed->begin_iteration(0, 1);
    sample(*changed, snapshot, settings);
    changed->resize(40, 16);
    const std::vector<vec4> none = picture(*changed, snapshot, settings);
    ASSERT_EQ(none.size(), 40u * 16u);
    for (const vec4& pixel : none) EXPECT_EQ(vec3(pixel), vec3(0.0f)) << estimator;
  }
}

// The renderer forgets where memory runs out or another map is loaded.
TEST_F(Mir, WhatIsForgottenUnderWayBeginsAnew) {
  const RenderSettings settings = settings_of("mir");
  const auto renderer = make_renderer(settings, 24, 16);
  scene::FrameSnapshot snapshot = room_of_two_lamps();
  for (const vec4& pixel : picture(*renderer, snapshot, settings))
    EXPECT_EQ(vec3(pixel), vec3(0.0f)) << "of no iterations";
  const auto run = [&](bool forgets) {
    snapshot.frame = 100;
    if (forgets) {
      for (std::uint32_t iteration = 0; iteration < 2; ++iteration) {
        renderer->begin_iteration(iteration, 2);
        sample(*renderer, snapshot, settings);
      }
      renderer->reset_learning();
      snapshot.frame = 100;
    }
    for (int k = 0; k < 3; ++k) {
      renderer->begin_iteration(1, 3);  // the same goes on
      sample(*renderer, snapshot, settings);
    }
    return picture(*renderer, snapshot, settings);
  };
  renderer->reset_learning();
  const std::vector<vec4> expected = run(false);
  renderer->reset_learning();
  EXPECT_EQ(run(true), expected);
}

// Outliers are removed of pictures all of whose samples were kept for it.
TEST_F(Mir, OutliersAreRemovedFromTheFirstSampleOnOrNotAtAll) {
  RenderSettings settings = settings_of("mir");
  const auto renderer = make_renderer(settings, 24, 16);
  const auto run = [&](float first, float then) {
    renderer->reset_learning();
    scene::FrameSnapshot snapshot = room_of_two_lamps();
    for (std::uint32_t iteration = 0; iteration < 2; ++iteration) {
      settings.mir_outliers = iteration == 0 ? first : then;
      renderer->begin_iteration(iteration, 2);
      for (int k = 0; k < 2; ++k) sample(*renderer, snapshot, settings);
    }
    return picture(*renderer, snapshot, settings);
  };
  const std::vector<vec4> all = run(0, 0);
  EXPECT_EQ(run(0, 4), all);
  EXPECT_EQ(run(4, 0), all);
  EXPECT_NE(run(4, 4), all);
}

// The nearest lamp along a ray, which begins outside of all.
struct Met {
  const Lamp* lamp = nullptr;
  double distance = 1e30, cosine = 0;
  int edges = 0;  // 1: so near to an edge that rounding may choose another face
};
Met met_by(const glm::dvec3& from, const glm::dvec3& direction) {
  Met met;
  for (const Lamp& lamp : kLamps) {
    double enters = -1e30, leaves = 1e30, cosine = 0, second = -1e30;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (static_cast<double>(lamp.low[axis]) - from[axis]) / direction[axis];
      const double b = (static_cast<double>(lamp.high[axis]) - from[axis]) / direction[axis];
      second = std::max(second, std::min(std::min(a, b), enters));
      if (std::min(a, b) > enters) {
        enters = std::min(a, b);
        cosine = std::abs(direction[axis]);
      }
      leaves = std::min(leaves, std::max(a, b));
    }
    if (enters > leaves || enters < 0 || enters > met.distance) continue;
    met = {&lamp, enters, cosine, enters - second < 1e-2 || leaves - enters < 1e-2 ? 1 : 0};
  }
  return met;
}

// Any number in the place of these densities is unbiased if both ends have the same: that it is what the list draws
// with is what the weights' variance hangs on.
TEST_F(Mir, DensitiesOfLookingForLightAreThoseOfTheList) {
  RenderSettings settings = settings_of("mir_nee");
  settings.nee_candidates = 3;
  const auto renderer = make_renderer(settings, 32, 24);
  scene::FrameSnapshot snapshot = room_of_two_lamps();
  renderer->begin_iteration(0, 2);
  for (int k = 0; k < 2; ++k) sample(*renderer, snapshot, settings);
  const Bytes state = renderer->save_iterations();
  // What MirTechnique::save_iterations has before its paths.
  ByteReader reader(state, "state");
  IterationPictures pictures;
  SingleSamples samples;
  GuidingTrees trees;
  PathStore store;
  std::vector<double> seen;
  std::vector<glm::dvec3> shifted;
  std::uint32_t frames = 0, salt = 0;
  std::uint64_t let_go = 0;
  double light = 0, host_ms = 0;
  ASSERT_TRUE(pictures.load(reader) && take_array(reader, seen) && take_array(reader, shifted) &&
              take_value(reader, frames) && samples.load(reader, shifted.size()) && take_value(reader, salt) &&
              take_value(reader, let_go) && take_value(reader, light) && take_value(reader, host_ms) &&
              trees.load(reader) && store.load(reader, shifted.size(), seen.size(), frames));

  // Each of the candidates is a point of a lamp, uniform on its faces, as often as its power says.
  const double power = kLamps[0].power() + kLamps[1].power();
  std::uint32_t looked = 0, met = 0;
  double worst = 0;  // relative
  const auto expect = [&](const vec3& position, const vec3& direction, float density, std::uint32_t& count) {
    glm::dvec3 from(position);
    for (int axis = 0; axis < 3; ++axis)  // rays begin a little before the wall
      if (std::abs(from[axis]) > static_cast<double>(kHalfRoom) - 1e-2)
        from[axis] -= (from[axis] > 0 ? 1 : -1) * (2e-3 + 1e-6 * static_cast<double>(kHalfRoom));
    const Met hit = met_by(from, glm::normalize(glm::dvec3(direction)));
    ASSERT_NE(hit.lamp, nullptr) << "light was met";
    if (hit.edges > 0 || hit.cosine < 0.05) return;  // rounding of a direction shows
    const double expected = settings.nee_candidates * static_cast<double>(hit.lamp->radiance) / power * hit.distance *
                            hit.distance / hit.cosine;
    worst = std::max(worst, std::abs(static_cast<double>(density) / expected - 1));
    ++count;
  };
  for (const PathStore::Path& path : store.paths()) {
    const StoredPath stored = store.stored(path);
    for (const LookedFor& found : stored.looked)
      if (found.density > 0)  // else it was found by one ray in turns
        expect(stored.vertices[found.vertex].position, found.direction, found.density, looked);
    for (const PathVertex& vertex : stored.vertices)
      if (vertex.met_density > 0) expect(vertex.position, vertex.direction, vertex.met_density, met);
  }
  std::printf("%u looked for, %u met; densities are off by up to %.1e\n", looked, met, worst);
  EXPECT_LT(worst, 1e-4);
  EXPECT_GT(looked, 1000u);
  EXPECT_GT(met, 50u);
}

}  // namespace
}  // namespace fb::render
