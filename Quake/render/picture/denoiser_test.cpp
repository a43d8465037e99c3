// The denoiser on scenes made in code: energy, error, non-finite values, repeatability.
#include "render/picture/denoiser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/hash.h"
#include "render/test_denoiser.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/denoise.h"

namespace fb::render {
namespace {

using DenoiserTest = DeviceTest;

// --- energy ---

TEST_F(DenoiserTest, AFurnaceKeepsItsValueAtEveryFrame) {
  const float albedo = 0.6f, emission = 0.7f;
  const double expected = emission * (1.0 + albedo + albedo * albedo);
  for (const bool still : {false, true}) {
    RenderSettings s = denoising();
    s.accumulate = still ? 1 : 0;
    auto renderer = make_renderer(s, 72, 40);
    const scene::FrameSnapshot snapshot = scene::furnace(albedo, emission, true);
    for (int frame = 0; frame < 8; ++frame) {
      renderer->render(still ? snapshot : at_time(snapshot, frame), nullptr, s);
      std::vector<double> values;
      for (const vec4& p : renderer->read().denoised()) values.push_back(p.x);
      // Every path has the same value; what is left is the history's precision: a step of pack_rgb9e5 is at most 1/256,
      // and its random rounding is averaged by the levels. Lost rays are the raw picture's too (renderer_test).
      for (const double v : values) EXPECT_NEAR(v, expected, expected / 200) << frame;
      double mean = 0;
      for (const double v : values) mean += v / static_cast<double>(values.size());
      EXPECT_NEAR(mean, expected, expected * 1e-3) << frame;
    }
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
  }
}

TEST_F(DenoiserTest, TheRawMeanIsTheSameBitsWithAndWithout) {
  std::vector<std::uint64_t> hashes;
  for (const int denoise : {0, 1}) {
    RenderSettings s = denoising();
    s.denoise = denoise;
    s.jitter = 0;
    s.firefly = 3;
    auto renderer = make_renderer(s, 64, 40);
    const scene::FrameSnapshot snapshot = scene::cornell_box();
    for (int frame = 0; frame < 3; ++frame) renderer->render(at_time(snapshot, frame), nullptr, s);
    const auto image = renderer->read().linear();
    hashes.push_back(hash_span(std::span<const vec4>(image)));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// --- error ---

TEST_F(DenoiserTest, ErrorFallsAtOneSample) {
  // 25 frames of 1 sample hold 1/25 of a sample's variance by themselves, less what the least weight of 0.04 keeps
  // (2/49); the wavelet's footprint of up to 3125 pixels does the rest, limited by edges of the light.
  RenderSettings s = denoising();
  s.jitter = 0;
  const scene::FrameSnapshot snapshot = scene::cornell_box();
  const auto make = [&](const RenderSettings& settings) { return make_renderer(settings, 96, 96); };
  const auto reference = reference_of(make, snapshot, 48);
  auto renderer = make(s);
  double first = 0, late = 0;
  for (int frame = 0; frame < 30; ++frame) {
    renderer->render(at_time(snapshot, frame), nullptr, s);
    const double factor = mean_square_difference(renderer->read().linear(), reference) /
                          mean_square_difference(renderer->read().denoised(), reference);
    if (frame == 0) first = factor;
    late = factor;
  }
  RecordProperty("first_frame", std::to_string(first));
  RecordProperty("frame_30", std::to_string(late));
  EXPECT_GT(first, 8);
  EXPECT_GT(late, 49);
}

TEST_F(DenoiserTest, AFrameWithoutAPastHasMoreSamples) {
  const scene::FrameSnapshot snapshot = scene::cornell_box();
  const auto make = [&](const RenderSettings& settings) { return make_renderer(settings, 48, 48); };
  const auto reference = reference_of(make, snapshot, 24);
  double error[2] = {};
  for (const int first : {1, 16}) {
    RenderSettings s = denoising();
    s.jitter = 0;
    s.first_spp = first;
    auto renderer = make(s);
    const auto count = static_cast<std::uint32_t>(first);
    for (int frame = 0; frame < 5; ++frame) {
      scene::FrameSnapshot now = at_time(snapshot, frame);
      now.cut = frame == 3;
      renderer->render(now, nullptr, s);
      if (frame == 3) error[first == 1 ? 0 : 1] = mean_square_difference(renderer->read().linear(), reference);
      // They count as frames, and those after them as one each.
      const std::uint32_t expected =
          frame < 3 ? count + static_cast<std::uint32_t>(frame) : count + static_cast<std::uint32_t>(frame - 3);
      const std::vector<std::uint32_t> frames = history_lengths(*renderer);
      EXPECT_EQ(*std::max_element(frames.begin(), frames.end()), expected) << frame;
    }
  }
  EXPECT_LT(error[1], 0.25 * error[0]) << "sixteen samples have a sixteenth of the variance";
  for (const char* name : {"pt", "mcpg"}) {
    RenderSettings s = denoising();
    s.estimator = name;
    s.first_spp = 8;
    auto renderer = make(s);
    renderer->render(snapshot, nullptr, s);
    const std::vector<std::uint32_t> frames = history_lengths(*renderer);
    EXPECT_EQ(*std::max_element(frames.begin(), frames.end()), 8u) << name;
  }
}

// Light of a sample in four pixels: what few of them say of its deviation parts a rare bright one from its neighbours,
// and it stands as a blotch.
TEST_F(DenoiserTest, YoungPixelsShareRareLight) {
  const scene::FrameSnapshot snapshot = scene::many_lights(400);
  const auto make = [&](const RenderSettings& settings) { return make_renderer(settings, 96, 96); };
  const auto reference = reference_of(make, snapshot, 96);
  int bright[2] = {};
  for (const bool settles : {false, true}) {
    RenderSettings s = denoising();
    s.jitter = 0;
    s.light_scale = 0.5f;
    s.first_spp = 4;
    if (!settles) s.svgf_settle = 1;
    auto renderer = make(s);
    for (int frame = 0; frame < 8; ++frame) {
      renderer->render(at_time(snapshot, frame), nullptr, s);
      if (frame < 3) continue;
      const std::vector<vec4> picture = renderer->read().denoised();
      for (std::size_t i = 0; i < picture.size(); ++i)
        if (luminance(picture[i]) > 2 * luminance(reference[i]) + 1e-3f) ++bright[settles ? 1 : 0];
    }
  }
  RecordProperty("pixels", std::to_string(bright[0]) + " without, " + std::to_string(bright[1]) + " with");
  EXPECT_LT(bright[1], bright[0] * 3 / 4);
}

// A puddle lies in the plane of its floor; what it mirrors is not the light that falls on the ground beside it.
TEST_F(DenoiserTest, APuddleSharesNothingWithItsFloor) {
  RenderSettings s = denoising();
  s.jitter = 0;
  double error[2] = {};
  for (const bool liquid : {false, true}) {
    scene::FrameSnapshot snapshot = scene::cornell_box();
    auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
    assets->generation = scene::next_generation();
    scene::Mesh& room = assets->meshes[snapshot.instances[0].mesh];
    const auto puddle = static_cast<std::uint32_t>(assets->materials.size());
    assets->materials.push_back(assets->materials[room.triangles[0].material]);
    assets->materials[puddle].base_color = vec3(0.02f);
    assets->materials[puddle].specular = 0.5f;
    assets->materials[puddle].roughness = 0.1f;
    assets->materials[puddle].flags |= scene::kMaterialWarp | (liquid ? scene::kMaterialLiquid : 0u);
    room.triangles[1].material = puddle;  // half of the floor
    const auto bright = static_cast<std::uint32_t>(assets->materials.size());
    assets->materials.emplace_back();
    assets->materials[bright].emission = vec3(20.0f);
    assets->materials[bright].emission_kind = scene::EmissionKind::kConstant;
    room.triangles[4].material = room.triangles[5].material = bright;  // the wall that the puddle mirrors
    snapshot.assets = assets;
    const auto make = [&](const RenderSettings& settings) { return make_renderer(settings, 96, 96); };
    const auto reference = reference_of(make, snapshot, 48);
    auto renderer = make(s);
    for (int frame = 0; frame < 16; ++frame) renderer->render(at_time(snapshot, frame), nullptr, s);
    const std::vector<vec4> picture = renderer->read().denoised();
    const auto gbuffer = renderer->read().gbuffer();
    for (std::size_t i = 0; i < picture.size(); ++i) {
      if ((gbuffer[i].material_metalness & shared::kTexelMaterial) != room.triangles[0].material) continue;
      const double relative = (luminance(picture[i]) - luminance(reference[i])) / (luminance(reference[i]) + 1e-2);
      error[liquid ? 1 : 0] += relative * relative;
    }
  }
  RecordProperty("error", std::to_string(error[0]) + " as one surface, " + std::to_string(error[1]) + " as a liquid");
  EXPECT_LT(error[1], error[0] * 0.75);
}

// A normal map turns what is shaded, not the plane on which neighbours are looked for.
TEST_F(DenoiserTest, ANormalMapTiltsNoPlane) {
  RenderSettings s = denoising();
  s.jitter = 0;
  const uvec2 size(96, 54);
  const auto tilted = [](scene::FrameSnapshot snapshot) {
    auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
    assets->generation = scene::next_generation();
    const auto bump = static_cast<std::uint32_t>(assets->images.size());
    assets->images.push_back({"bump", scene::ImageEncoding::kLinearRgba, 1, 1, {182, 182, 226, 255}});  // 37 degrees
    for (scene::Material& m : assets->materials) {
      if (m.frames.empty()) m.frames.push_back({});
      for (scene::TextureSet& set : m.frames) set.normal = bump;
    }
    snapshot.assets = assets;
    return snapshot;
  };
  struct Seen {
    double gained;  // MSE, by a first frame's filter
    int turned = 0;
  };
  const auto look = [&](scene::FrameSnapshot snapshot) {
    snapshot.camera.position = vec3(40, 0, 10);  // along the floor
    snapshot.prev_camera = snapshot.camera;
    const auto make = [&](const RenderSettings& settings) { return make_renderer(settings, size.x, size.y); };
    const auto reference = reference_of(make, snapshot, 48);
    auto renderer = make(s);
    renderer->render(at_time(snapshot, 0), nullptr, s);
    Seen seen{mean_square_difference(renderer->read().linear(), reference) /
              mean_square_difference(renderer->read().denoised(), reference)};
    for (const auto& g : renderer->read().gbuffer()) seen.turned += g.shading_normal != g.normal;
    return seen;
  };
  const Seen flat = look(scene::cornell_box()), bumpy = look(tilted(scene::cornell_box()));
  EXPECT_EQ(flat.turned, 0);
  EXPECT_GT(bumpy.turned, static_cast<int>(size.x * size.y / 2));
  EXPECT_GT(bumpy.gained, 0.7 * flat.gained);  // 0.93; 0.38 by the plane that the normal map would have
}

TEST_F(DenoiserTest, AStillViewConvergesToTheRawMean) {
  RenderSettings s = denoising();
  s.accumulate = 1;
  s.jitter = 0;
  s.svgf_mean_frames = 4;
  const scene::FrameSnapshot snapshot = scene::cornell_box();
  auto renderer = make_renderer(s, 48, 48);
  for (int frame = 0; frame < 400; ++frame) renderer->render(snapshot, nullptr, s);
  // The mean's weight is n / (n + 4): what is left of any difference is a hundredth of it.
  const auto raw = renderer->read().linear(), denoised = renderer->read().denoised();
  for (std::size_t i = 0; i < raw.size(); ++i) EXPECT_NEAR(denoised[i].x, raw[i].x, 0.01f * (raw[i].x + 0.2f)) << i;
}

// --- bad numbers, repetition ---

TEST_F(DenoiserTest, WhatIsNotFiniteNeverEntersTheHistory) {
  const RenderSettings s = denoising();
  scene::FrameSnapshot snapshot = scene::moving(scene::moving_assets(), 0.1, 0.0);
  for (scene::Instance& i : snapshot.instances) {
    if (i.id != scene::kMovingViewModel) continue;  // the camera alone sees it
    i.flags |= scene::kInstanceColor;
    i.color = vec3(0.5f);
    i.emission = vec3(std::numeric_limits<float>::quiet_NaN());
  }
  auto renderer = make_renderer(s, 96, 64);
  for (int frame = 0; frame < 3; ++frame) renderer->render(at_time(snapshot, frame), nullptr, s);
  EXPECT_GT(renderer->read().counters().history_not_finite, 0u);
  const auto gbuffer = renderer->read().gbuffer();
  const auto denoised = renderer->read().denoised();
  for (std::size_t i = 0; i < gbuffer.size(); ++i) {
    if (gbuffer[i].id == scene::kMovingViewModel) continue;
    ASSERT_TRUE(std::isfinite(denoised[i].x) && std::isfinite(denoised[i].y) && std::isfinite(denoised[i].z)) << i;
  }
  for (const auto& texel : renderer->read().history()) {
    for (const std::uint32_t half :
         {texel.x & 0xffffu, texel.x >> 16u, texel.y & 0xffffu, texel.z & 0xffffu, texel.z >> 16u})
      ASSERT_NE(half & 0x7c00u, 0x7c00u) << "an infinity or a NaN";
  }
}

TEST_F(DenoiserTest, TheSameFramesGiveTheSameBits) {
  std::set<std::uint64_t> hashes;
  const auto assets = scene::moving_assets();
  for (int run = 0; run < 2; ++run) {
    const RenderSettings s = denoising();
    auto renderer = make_renderer(s, 128, 72);
    for (int frame = 1; frame <= 6; ++frame) {
      scene::FrameSnapshot snapshot = scene::moving(assets, frame / 30.0, (frame - 1) / 30.0);
      snapshot.frame = static_cast<std::uint64_t>(frame);
      renderer->render(snapshot, nullptr, s);
    }
    const auto pixels = renderer->read().output();
    const auto history = renderer->read().history();
    hashes.insert(hash_bytes(history.data(), history.size() * sizeof(history[0]),
                             hash_span(std::span<const std::uint32_t>(pixels))));
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST_F(DenoiserTest, ItsDebugViewsDiffer) {
  RenderSettings s = denoising();
  auto renderer = make_renderer(s, 96, 64);
  std::set<std::uint64_t> pictures;
  int frame = 1;
  for (const int view : {0, 12, 13, 14, 15, 16}) {
    s.debug_view = view;
    for (int i = 0; i < 5; ++i, ++frame) {
      const auto snapshot = scene::moving(scene::moving_assets(), frame / 30.0, (frame - 1) / 30.0);
      renderer->render(at_time(snapshot, frame), nullptr, s);
    }
    const auto pixels = renderer->read().output();
    pictures.insert(hash_span(std::span<const std::uint32_t>(pixels)));
  }
  EXPECT_EQ(pictures.size(), 6u);
}

}  // namespace
}  // namespace fb::render
