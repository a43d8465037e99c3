// Reservoirs of light where they are hard to keep: a single texel that glows, thousands of lamps, W from nothing to
// beyond a million, confidence at its most, neighbours behind a wall, time that jumps back, light that is no number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/techniques/test_restir.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_light.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

using RestirLimitsSequences = RestirTest;

// A floor, seen from above, and what is added to it; its light comes from what hangs over it, behind the camera.
class FloorScene {
 public:
  FloorScene() : grey_(scene::add_material(*assets_, "floor", vec3(0.5f))) {
    scene::Mesh ground;
    scene::add_quad(ground, {-128, -128, 0}, {256, 0, 0}, {0, 256, 0}, grey_);
    ground_ = scene::add_finished(*assets_, std::move(ground), "floor");
  }
  scene::Assets& assets() { return *assets_; }
  std::uint32_t grey() const { return grey_; }
  std::uint32_t glow(const vec3& radiance) { return scene::add_material(*assets_, "lamp", vec3(0.0f), radiance); }
  void add(scene::Mesh mesh) { meshes_.push_back(scene::add_finished(*assets_, std::move(mesh), "part")); }
  scene::FrameSnapshot snapshot() const {
    scene::FrameSnapshot s = scene::still(assets_, scene::camera_at({0, 0, 90}, {90, 0, 0}, 90));
    s.instances.push_back(scene::make_instance(scene::kIdWorld, ground_));
    for (std::size_t i = 0; i < meshes_.size(); ++i)
      s.instances.push_back(scene::make_instance(static_cast<std::uint32_t>(100 + i), meshes_[i]));
    return s;
  }

 private:
  std::shared_ptr<scene::Assets> assets_ = scene::new_code_assets();
  std::uint32_t grey_, ground_;
  std::vector<std::uint32_t> meshes_;
};

// A quad that faces down.
void add_lamp(scene::Mesh& mesh, const vec3& middle, float size, std::uint32_t material) {
  scene::add_quad(mesh, middle - vec3(size / 2, size / 2, 0), {0, size, 0}, {size, 0, 0}, material);
}

// 40,000 quads: a lamp is eight triangles at most (GpuLamp).
scene::Mesh ten_thousand_lamps(float size, std::uint32_t material) {
  scene::Mesh lamps;
  for (int i = 0; i < 40000; ++i) {
    const vec2 at = vec2(static_cast<float>(i % 200), static_cast<float>(i / 200)) * 1.5f - 149.25f;
    add_lamp(lamps, vec3(at, 120), size, material);
  }
  return lamps;
}

struct Compared {
  int runs = 16, skip = 6, frames = 6;
  std::uint32_t width = 32, height = 24;
};
Means means_of(RenderSettings s, const scene::FrameSnapshot& snapshot, const Compared& plan, gpu::Device& device) {
  Means means;
  for (int run = 0; run < plan.runs; ++run) {
    s.seed = run;
    auto renderer = Renderer::create(device, s);
    if (!renderer) return means;
    (*renderer)->resize(plan.width, plan.height);
    double m = 0;
    for (int frame = 0; frame < plan.skip + plan.frames; ++frame) {
      (*renderer)->render(snapshot, nullptr, s);
      if (frame >= plan.skip) m += mean_of(**renderer) / plan.frames;
    }
    EXPECT_EQ((*renderer)->read().counters().not_finite, 0u);
    means.add(m);
  }
  return means;
}

std::uint64_t picture_of(RenderSettings s, const scene::FrameSnapshot& snapshot, int frames, gpu::Device& device) {
  s.deterministic = 1;
  auto renderer = Renderer::create(device, s);
  if (!renderer) return 0;
  (*renderer)->resize(32, 24);
  for (int i = 0; i < frames; ++i) (*renderer)->render(snapshot, nullptr, s);
  return image_hash(**renderer);
}

TEST_F(RestirLimitsSequences, OneTexelThatGlows) {
  FloorScene floor;
  scene::Image image{"one texel", scene::ImageEncoding::kSrgba, 4, 4, {}};
  for (int i = 0; i < 16; ++i) {
    const std::uint8_t c = i == 6 ? 255 : 0;
    image.texels.insert(image.texels.end(), {c, c, c, 255});
  }
  floor.assets().images.push_back(std::move(image));
  const auto texels = static_cast<std::uint32_t>(floor.assets().images.size() - 1);
  const std::uint32_t material = scene::add_material(floor.assets(), "texel", vec3(0.0f), vec3(1.0f));
  floor.assets().materials[material].emission_kind = scene::EmissionKind::kFullbright;
  floor.assets().materials[material].frames = {{.base = texels, .luma = texels}};
  scene::Mesh lamp;
  add_lamp(lamp, {0, 0, 120}, 64, material);
  floor.add(std::move(lamp));
  const scene::FrameSnapshot snapshot = floor.snapshot();
  const Compared plan{.width = 64, .height = 48};
  expect_equal(means_of(reuse_settings(1), snapshot, plan, *device_),
               means_of(reuse_settings(1, "nee"), snapshot, plan, *device_), 0.05);
}

// Of settings that are said to be unbiased, away from their defaults: each changes the picture and leaves the mean.
struct Change {
  const char* name;
  void (*apply)(RenderSettings&);
};
void expect_changes_to_leave_the_mean(std::span<const Change> changes, const RenderSettings& base,
                                      const scene::FrameSnapshot& scene, gpu::Device& device) {
  const Compared plan{.runs = 8};
  const Means expected = means_of(RestirTest::reuse_settings(base.bounces, "nee"), scene, plan, device);
  const std::uint64_t plain = picture_of(base, scene, 10, device);
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    RenderSettings s = base;
    change.apply(s);
    EXPECT_NE(picture_of(s, scene, 10, device), plain);
    expect_equal(means_of(s, scene, plan, device), expected, 0.01);
  }
}

TEST_F(RestirLimitsSequences, SettingsThatLeaveTheMean) {
  constexpr Change kOfReuse[] = {
      {"permuted", [](RenderSettings& s) { s.restir_permute = 1; }},
      {"neighbours are not kept", [](RenderSettings& s) { s.restir_keep = 0; }},
      {"without hope", [](RenderSettings& s) { s.restir_hope = 0; }},
      {"eight sets", [](RenderSettings& s) { s.restir_sets = 8; }},
  };
  constexpr Change kOfLobes[] = {{"not taught", [](RenderSettings& s) { s.restir_teach = 0; }}};
  // Light so large and close that scattered rays find most of it: what they leave to reservoirs hangs on trust.
  constexpr Change kOfTrust[] = {
      {"no trust", [](RenderSettings& s) { s.restir_trust = 0.1f; }},
      {"all trust", [](RenderSettings& s) { s.restir_trust = 1e6f; }},
  };
  const scene::FrameSnapshot box = scene::cornell_box();
  expect_changes_to_leave_the_mean(kOfReuse, reuse_settings(2, "restir_gi"), box, *device_);
  expect_changes_to_leave_the_mean(kOfLobes, reuse_settings(2, "restir_guided"), box, *device_);
  expect_changes_to_leave_the_mean(kOfTrust, reuse_settings(1), scene::lava_cave(), *device_);
}

// Without rays MIS weights suppose that all vertices see each other: what one alone sees is lost in part, a little.
TEST_F(RestirLimitsSequences, WeightsThatAskNoRaysLoseLittle) {
  const scene::FrameSnapshot box = scene::cornell_box();
  RenderSettings s = reuse_settings(2, "restir_gi");
  const std::uint64_t plain = picture_of(s, box, 10, *device_);
  s.restir_gi_visibility = 0;
  EXPECT_NE(picture_of(s, box, 10, *device_), plain);
  const Means exact = means_of(reuse_settings(2, "nee"), box, {}, *device_), found = means_of(s, box, {}, *device_);
  const double error = std::hypot(exact.error(), found.error());
  EXPECT_LT(error, 0.005 * exact.mean) << "the test can see little";
  EXPECT_LT(found.mean, exact.mean + 4.5 * error);
  EXPECT_GT(found.mean, 0.98 * exact.mean - 4.5 * error);
}

// First vertices closer to a wall than a 65,536th of its width: a second vertex whose place was rounded so would often
// lie below the floor, and what it reflects be lost.
TEST_F(RestirLimitsSequences, SecondVerticesCloseBy) {
  FloorScene floor;
  scene::Mesh wall, lamp;
  scene::add_quad(wall, {0.25f, -4096, 0}, {0, 0, 8192}, {0, 8192, 0}, floor.grey());
  add_lamp(lamp, {-60, 0, 100}, 64, floor.glow(vec3(10.0f)));
  floor.add(std::move(wall));
  floor.add(std::move(lamp));
  scene::FrameSnapshot snapshot = floor.snapshot();
  snapshot.camera = scene::camera_at({0, 0, 0.25f}, {90, 0, 0}, 90);
  RenderSettings s = reuse_settings(2, "restir_gi");
  const Means expected = means_of(reuse_settings(2, "nee"), snapshot, {.runs = 8}, *device_);
  const Means one = means_of(reuse_settings(1, "nee"), snapshot, {.runs = 8}, *device_);
  EXPECT_GT(expected.mean, 1.1 * one.mean) << "the wall reflects nothing";
  expect_equal(means_of(s, snapshot, {.runs = 8}, *device_), expected, 0.01);
}

TEST_F(RestirLimitsSequences, TenThousandLamps) {
  FloorScene floor;
  floor.add(ten_thousand_lamps(0.25f, floor.glow(vec3(40.0f))));
  const scene::FrameSnapshot snapshot = floor.snapshot();
  expect_equal(means_of(reuse_settings(1), snapshot, {}, *device_),
               means_of(reuse_settings(1, "nee"), snapshot, {}, *device_), 0.02);
}

// What the debug view shows of each pixel: its green channel, 0 to 1.
std::vector<float> shown(RenderSettings s, std::uint32_t view, const scene::FrameSnapshot& snapshot, int frames,
                         gpu::Device& device) {
  s.auto_exposure = s.fxaa = s.tone_map = 0;
  s.debug_view = static_cast<int>(view);
  std::vector<float> values;
  auto renderer = Renderer::create(device, s);
  if (!renderer) return values;
  (*renderer)->resize(32, 24);
  for (int i = 0; i < frames; ++i) (*renderer)->render(snapshot, nullptr, s);
  for (const std::uint32_t pixel : (*renderer)->read().output())
    values.push_back(static_cast<float>((pixel >> 8u) & 255u) / 255.0f);
  return values;
}

// A lamp under the floor takes nearly all draws of the list; each of ten thousand that light the floor has hardly any,
// and a W beyond a million where it is found. Where there is no other lamp there is no W.
TEST_F(RestirLimitsSequences, WeightsBeyondAMillionAndOfNothing) {
  for (const bool shines : {true, false}) {
    FloorScene floor;
    scene::Mesh hidden;
    add_lamp(hidden, {0, 0, -100}, 16, floor.glow(vec3(1e6f)));
    floor.add(std::move(hidden));
    if (shines) floor.add(ten_thousand_lamps(1.0f, floor.glow(vec3(1.0f))));
    const scene::FrameSnapshot snapshot = floor.snapshot();
    const RenderSettings s = reuse_settings(1);
    if (shines) {
      RenderSettings by_chance = s;
      by_chance.nee_remembered = by_chance.restir_neighbors = 0;
      by_chance.restir_history = 0;  // which would count it as many frames' candidates
      const std::vector<float> weights = shown(by_chance, shared::kViewRestirWeight, snapshot, 24, *device_);
      EXPECT_GT(*std::max_element(weights.begin(), weights.end()), 0.999f) << "log2 of W over 40, from the middle";
      expect_equal(means_of(s, snapshot, {}, *device_), means_of(reuse_settings(1, "pt"), snapshot, {}, *device_),
                   0.02);
    } else {
      EXPECT_EQ(means_of(s, snapshot, {.runs = 2}, *device_).mean, 0.0);
    }
  }
}

TEST_F(RestirLimitsSequences, ConfidenceEndsAtItsMost) {
  FloorScene floor;
  scene::Mesh lamp;
  add_lamp(lamp, {0, 0, 120}, 64, floor.glow(vec3(1.0f)));
  floor.add(std::move(lamp));
  RenderSettings s = reuse_settings(1);
  s.restir_neighbors = 0;
  s.restir_history = 20;
  for (const auto& [frames, confidence] : {std::pair{1, 1.0f}, {8, 8.0f}, {21, 21.0f}, {40, 21.0f}})
    for (const float value : shown(s, shared::kViewRestirConfidence, floor.snapshot(), frames, *device_))
      ASSERT_NEAR(value, confidence / 64.0f, 0.5f / 255.0f + 1e-5f) << frames;
  // The most that there is, which sums of neighbours' would exceed.
  s.restir_neighbors = s.restir_gi_neighbors = 8;
  s.restir_history = s.restir_gi_history = 1000;
  for (const char* estimator : {"restir_di", "restir_gi"}) {
    s.estimator = estimator;
    expect_equal(means_of(s, floor.snapshot(), {.runs = 8}, *device_),
                 means_of(reuse_settings(1, "nee"), floor.snapshot(), {.runs = 8}, *device_), 0.02);
  }
}

// Pixels on both sides of a wall seen edge on have one normal and one depth, so each is the other's neighbour.
TEST_F(RestirLimitsSequences, NeighboursBehindAWall) {
  FloorScene floor;
  scene::Mesh parts;
  scene::add_box(parts, {-0.25f, -140, 0}, {0.25f, 140, 70}, floor.grey());
  add_lamp(parts, {-60, 0, 30}, 40, floor.glow(vec3(10.0f)));
  floor.add(std::move(parts));
  const scene::FrameSnapshot snapshot = floor.snapshot();
  double dark = 0;
  RenderSettings s = reuse_settings(1);
  s.restir_neighbors = 8;
  auto renderer = make_renderer(s, 32, 24);
  render_still(*renderer, snapshot, s, 12);
  const std::vector<vec4> image = renderer->read().linear();
  const auto gbuffer = renderer->read().gbuffer();
  int counted = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (gbuffer[i].position_t.x < 1.0f) continue;
    dark += image[i].x;
    ++counted;
  }
  EXPECT_GT(counted, 100);
  EXPECT_EQ(dark, 0.0) << "light through the wall";
  expect_equal(means_of(s, snapshot, {}, *device_), means_of(reuse_settings(1, "nee"), snapshot, {}, *device_), 0.02);
}

// A demo that is sought backwards without a cut: lamps jump to where they were, and others are lit than before.
TEST_F(RestirLimitsSequences, TimeJumpsBack) {
  const auto assets = scene::candle_assets();
  std::vector<scene::FrameSnapshot> film;
  double former = 2.0;
  for (const double time : {2.0, 2.05, 2.1, 2.15, 2.2, 2.25, 0.4, 0.45, 1.9, 0.1})
    film.push_back(scene::candles(assets, time, std::exchange(former, time)));
  for (const bool cut : {false, true}) {
    Means of[2];
    for (const bool reuses : {false, true}) {
      for (int run = 0; run < 16; ++run) {
        RenderSettings s = reuse_settings(1, reuses ? "restir_di" : "nee");
        s.seed = run;
        auto renderer = make_renderer(s, 32, 24);
        double m = 0;
        for (std::size_t i = 0; i < film.size(); ++i) {
          scene::FrameSnapshot frame = film[i];
          frame.cut = cut && i >= 6;
          renderer->render(frame, nullptr, s);
          if (i >= 6) m += mean_of(*renderer) / 4;
        }
        EXPECT_EQ(renderer->read().counters().not_finite, 0u);
        of[reuses ? 1 : 0].add(m);
      }
    }
    expect_equal(of[1], of[0], 0.04);
  }
}

// A lamp whose light is no number: what is lost of it is counted, no pixel shows it, and when it has gone its light is
// in no reservoir.
TEST_F(RestirLimitsSequences, LightThatIsNoNumberIsCountedAndZero) {
  for (const float radiance : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (const auto& [estimator, keeps_radiance] :
         {std::pair{"restir_di", 0}, std::pair{"restir_gi", 0}, std::pair{"restir_gi", 1}}) {
      FloorScene floor;
      scene::Mesh good, bad;
      add_lamp(good, {-60, 0, 120}, 32, floor.glow(vec3(4.0f)));
      add_lamp(bad, {60, 0, 120}, 32, floor.glow(vec3(4.0f)));
      floor.add(std::move(good));
      floor.add(std::move(bad));
      const scene::FrameSnapshot sound = floor.snapshot();
      scene::FrameSnapshot broken = sound;
      broken.instances.back().flags |= scene::kInstanceColor;
      broken.instances.back().color = vec3(0.0f);
      broken.instances.back().emission = vec3(radiance);
      RenderSettings s = reuse_settings(2, estimator);
      s.restir_gi_radiance = keeps_radiance;
      auto renderer = make_renderer(s, 32, 24);
      for (int frame = 0; frame < 8; ++frame) {
        renderer->render(broken, nullptr, s);
        for (const vec4& pixel : renderer->read().linear())
          ASSERT_TRUE(std::isfinite(pixel.x) && pixel.x >= 0.0f && pixel.x < 100.0f) << estimator << ' ' << pixel.x;
      }
      const std::uint32_t lost = renderer->read().counters().not_finite;  // since the renderer was made
      EXPECT_GT(lost, 0u) << estimator;
      for (int frame = 0; frame < 4; ++frame) renderer->render(sound, nullptr, s);
      EXPECT_EQ(renderer->read().counters().not_finite, lost) << estimator;
      EXPECT_GT(mean_of(*renderer), 0.0) << estimator;
    }
  }
}

}  // namespace
}  // namespace fb::render
