// The denoiser in motion: when its history is kept, and when it is discarded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/picture/denoiser.h"
#include "render/test_denoiser.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/denoise.h"

namespace fb::render {
namespace {

using DenoiserTest = DeviceTest;

struct Surroundings {
  bool all_same = true, any_same = false;
};
// Whether the previous frame's pixels about `point` showed the instance `id` within a few percent of `depth`.
Surroundings surroundings(const std::vector<shared::GBufferTexel>& before, uvec2 size, vec2 point, std::uint32_t id,
                          float depth, int radius) {
  Surroundings s;
  const int cx = static_cast<int>(std::floor(point.x)), cy = static_cast<int>(std::floor(point.y));
  for (int y = cy - radius; y <= cy + radius; ++y) {
    for (int x = cx - radius; x <= cx + radius; ++x) {
      const bool inside = x >= 0 && y >= 0 && x < static_cast<int>(size.x) && y < static_cast<int>(size.y);
      const auto* g = inside ? &before[static_cast<std::size_t>(y) * size.x + static_cast<std::size_t>(x)] : nullptr;
      const bool same = inside && g->id == id && g->position_t.w > 0 && std::abs(g->motion.z - depth) < 0.02f * depth;
      s.all_same &= same;
      s.any_same |= inside && g->id == id;
    }
  }
  return s;
}

TEST_F(DenoiserTest, HistoryFollowsWhatMovesAndIsDroppedWhereSomethingComesIntoSight) {
  const RenderSettings s = denoising();
  const uvec2 size(320, 180);
  const auto assets = scene::moving_assets();
  int followed = 0, lost = 0, box = 0, uncovered = 0, kept = 0;
  // A box that turns by 3.5 degrees and moves by some pixels a frame; then by five times as much, which uncovers more.
  for (const double step : {0.05, 0.25}) {
    auto renderer = make_renderer(s, size.x, size.y);
    std::vector<shared::GBufferTexel> before;
    for (int frame = 1; frame <= 8; ++frame) {
      scene::FrameSnapshot snapshot = scene::moving(assets, frame * step, (frame - 1) * step);
      snapshot.frame = static_cast<std::uint64_t>(frame);
      renderer->render(snapshot, nullptr, s);
      const auto now = renderer->read().gbuffer();
      const auto frames = history_lengths(*renderer);
      for (std::size_t i = 0; frame > 1 && i < now.size(); ++i) {
        const auto& g = now[i];
        if (g.position_t.w == 0) continue;
        const vec2 pixel(static_cast<float>(i % size.x), static_cast<float>(i / size.x));
        const Surroundings around =
            surroundings(before, size, pixel + 0.5f + vec2(g.motion.x, g.motion.y), g.id, g.motion.w, 2);
        if (around.all_same && step < 0.1) {
          ++(frames[i] > 1 ? followed : lost);
          box += g.id == scene::kMovingBox;
        } else if (!around.any_same) {
          ++uncovered;
          kept += frames[i] > 1;
        }
      }
      before = now;
    }
  }
  EXPECT_GT(box, 1000);
  EXPECT_GT(uncovered, 300);
  EXPECT_LT(lost, (followed + lost) / 200) << "of " << followed + lost;
  // Ids meet in 8 bits: one pair in 256 would pass by chance.
  EXPECT_LE(kept, uncovered / 50) << "of " << uncovered;
}

TEST_F(DenoiserTest, AnotherInstanceInTheSamePlaceHasNoHistory) {
  const RenderSettings s = denoising();
  auto renderer = make_renderer(s, 96, 96);
  scene::FrameSnapshot snapshot = scene::cornell_box();
  int frame = 0;
  for (; frame < 4; ++frame) renderer->render(at_time(snapshot, frame), nullptr, s);
  for (scene::Instance& i : snapshot.instances)
    if (i.id == scene::kIdEntity + 2) i.id = scene::kIdEntity + 9;
  renderer->render(at_time(snapshot, frame), nullptr, s);
  const auto gbuffer = renderer->read().gbuffer();
  const auto frames = history_lengths(*renderer);
  int count = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (gbuffer[i].id != scene::kIdEntity + 9) continue;
    EXPECT_EQ(frames[i], 1u) << i;
    ++count;
  }
  EXPECT_GT(count, 200);
}

TEST_F(DenoiserTest, DepthAndNormalTellWhatAnIdDoesNot) {
  // Everything is one instance by its id; then one of the boxes is gone.
  const RenderSettings s = denoising();
  const uvec2 size(96, 96);
  auto renderer = make_renderer(s, size.x, size.y);
  scene::FrameSnapshot with = scene::cornell_box();
  const auto box = std::find_if(with.instances.begin(), with.instances.end(),
                                [](const scene::Instance& i) { return i.id == scene::kIdEntity + 2; });
  const auto index = box - with.instances.begin();
  for (scene::Instance& i : with.instances) i.id = scene::kIdWorld;
  int frame = 0;
  for (; frame < 4; ++frame) renderer->render(at_time(with, frame), nullptr, s);
  const auto before = renderer->read().gbuffer();
  with.instances.erase(with.instances.begin() + index);
  renderer->render(at_time(with, frame), nullptr, s);
  const auto now = renderer->read().gbuffer();
  const auto frames = history_lengths(*renderer);
  int dropped = 0, kept = 0;
  for (std::size_t i = 3 * size.x + 3; i + 3 * size.x + 3 < now.size(); ++i) {
    if (now[i].position_t.w == 0) continue;
    bool other = true;  // nothing like it was near
    for (const int dy : {-3, 0, 3})
      for (const int dx : {-3, 0, 3}) {
        const auto j = static_cast<std::size_t>(static_cast<int>(i) + dy * static_cast<int>(size.x) + dx);
        other &= before[j].position_t.w > 0 && std::abs(before[j].motion.z - now[i].motion.z) > 0.15f * now[i].motion.z;
      }
    if (other) ++(frames[i] == 1 ? dropped : kept);
  }
  EXPECT_GT(dropped, 50);
  EXPECT_LE(kept, dropped / 50);
}

// Mean squared difference of a frame's luminance and the one before, where motion says each point was, over pixels
// whose surroundings were in sight; relative to the mean's square.
double flicker(const std::vector<vec4>& now, const std::vector<vec4>& before,
               const std::vector<shared::GBufferTexel>& g, const std::vector<shared::GBufferTexel>& g_before,
               uvec2 size) {
  double squares = 0, mean = 0;
  int count = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (g[i].position_t.w == 0) continue;
    const vec2 pixel(static_cast<float>(i % size.x), static_cast<float>(i / size.x));
    const vec2 point = pixel + 0.5f + vec2(g[i].motion.x, g[i].motion.y);
    if (!surroundings(g_before, size, point, g[i].id, g[i].motion.w, 1).all_same) continue;
    const auto j = static_cast<std::size_t>(point.y) * size.x + static_cast<std::size_t>(point.x);
    // Albedo apart, which a texel's edge changes and no filter should.
    const auto irradiance = [](const vec4& c, const shared::GBufferTexel& t) {
      return luminance(c - t.emission_specular) / std::max(luminance(t.albedo_roughness), 1e-3f);
    };
    const double d = irradiance(now[i], g[i]) - irradiance(before[j], g_before[j]);
    squares += d * d;
    mean += irradiance(now[i], g[i]);
    ++count;
  }
  mean /= count;
  return squares / count / (mean * mean);
}

TEST_F(DenoiserTest, PicturesAreSteadyInMotion) {
  const RenderSettings s = denoising();
  const uvec2 size(160, 90);
  auto renderer = make_renderer(s, size.x, size.y);
  const auto assets = scene::moving_assets();
  std::vector<vec4> raw, denoised;
  std::vector<shared::GBufferTexel> before;
  double raw_flicker = 0, denoised_flicker = 0;
  for (int frame = 1; frame <= 24; ++frame) {
    scene::FrameSnapshot snapshot = scene::moving(assets, frame / 60.0, (frame - 1) / 60.0);
    snapshot.frame = static_cast<std::uint64_t>(frame);
    renderer->render(snapshot, nullptr, s);
    const auto now = renderer->read().gbuffer();
    const auto raw_now = renderer->read().linear(), denoised_now = renderer->read().denoised();
    if (frame > 16) {
      raw_flicker += flicker(raw_now, raw, now, before, size);
      denoised_flicker += flicker(denoised_now, denoised, now, before, size);
    }
    raw = raw_now;
    denoised = denoised_now;
    before = now;
  }
  RecordProperty("raw_flicker", std::to_string(raw_flicker / 8));
  RecordProperty("denoised_flicker", std::to_string(denoised_flicker / 8));
  // A weight of 0.04 a frame changes a pixel by 0.04^2 of a sample's variance, and a sample's difference has twice
  // that.
  EXPECT_LT(denoised_flicker, raw_flicker * 0.04 * 0.04 / 2 + 8 * 0.01 * 0.01) << raw_flicker;
}

TEST_F(DenoiserTest, ACutAndANewSizeStartAnew) {
  const RenderSettings s = denoising();
  auto renderer = make_renderer(s, 64, 40);
  scene::FrameSnapshot snapshot = scene::cornell_box();
  const auto longest = [&] {
    const auto frames = history_lengths(*renderer);
    return *std::max_element(frames.begin(), frames.end());
  };
  int frame = 0;
  for (; frame < 5; ++frame) renderer->render(at_time(snapshot, frame), nullptr, s);
  EXPECT_EQ(longest(), 5u);
  snapshot.cut = true;
  renderer->render(at_time(snapshot, frame++), nullptr, s);
  EXPECT_EQ(longest(), 1u);
  snapshot.cut = false;
  renderer->render(at_time(snapshot, frame++), nullptr, s);
  EXPECT_EQ(longest(), 2u);
  renderer->resize(50, 30);
  renderer->render(at_time(snapshot, frame++), nullptr, s);
  EXPECT_EQ(longest(), 1u);
  RenderSettings off = s;
  off.denoise = 0;
  renderer->render(at_time(snapshot, frame++), nullptr, off);
  EXPECT_EQ(renderer->read().denoised(), renderer->read().linear());
  renderer->render(at_time(snapshot, frame++), nullptr, s);
  EXPECT_EQ(longest(), 1u) << "what was gathered before it was off is too old";
}

// --- what has gone ---

TEST_F(DenoiserTest, NothingIsLeftBehindByWhatHasGone) {
  // A white box before the Cornell box's walls for 40 frames, then away.
  RenderSettings s = denoising();
  s.auto_exposure = 0;
  scene::FrameSnapshot with = scene::cornell_box(), without = with;
  without.instances.erase(std::find_if(without.instances.begin(), without.instances.end(),
                                       [](const scene::Instance& i) { return i.id == scene::kIdEntity + 2; }));
  auto renderer = make_renderer(s, 128, 128), fresh = make_renderer(s, 128, 128);
  int frame = 0;
  for (; frame < 40; ++frame) {
    renderer->render(at_time(with, frame), nullptr, s);
    fresh->render(at_time(without, frame), nullptr, s);
  }
  const auto where = renderer->read().gbuffer();
  const auto box_picture = renderer->read().output();
  for (const int last = frame + 4; frame < last; ++frame) {
    renderer->render(at_time(without, frame), nullptr, s);
    fresh->render(at_time(without, frame), nullptr, s);
  }
  // The finished pictures, anti-aliasing included, where the box was: how much of it is left.
  const auto a = renderer->read().output(), b = fresh->read().output();
  double left = 0, whole = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (where[i].id != scene::kIdEntity + 2) continue;
    const auto green = [&](const std::vector<std::uint32_t>& image) {
      return static_cast<double>((image[i] >> 8u) & 255u);
    };
    left += green(a) - green(b);
    whole += green(box_picture) - green(b);
    ++count;
  }
  ASSERT_GT(count, 500);
  ASSERT_GT(std::abs(whole / count), 10);
  RecordProperty("left", std::to_string(left / whole));
  EXPECT_LT(std::abs(left / whole), 0.05);
}

TEST_F(DenoiserTest, LightThatChangesIsFollowed) {
  const RenderSettings s = denoising();
  scene::FrameSnapshot bright = scene::one_light(24, 60, 0.5f), dim = bright;
  for (scene::Instance& i : dim.instances)
    if (i.id == scene::kIdEntityLight) i.emission *= 0.1f;
  for (const bool darker : {true, false}) {
    auto renderer = make_renderer(s, 96, 64), fresh = make_renderer(s, 96, 64);
    int frame = 0;
    for (; frame < 40; ++frame) renderer->render(at_time(darker ? bright : dim, frame), nullptr, s);
    const auto settled = [&] {
      for (int i = 0; i < 40; ++i) fresh->render(at_time(darker ? dim : bright, i), nullptr, s);
      return mean_luminance(fresh->read().denoised());
    }();
    const double start = mean_luminance(renderer->read().denoised());
    int needed = 0;
    while (needed < 100) {
      ++needed;
      renderer->render(at_time(darker ? dim : bright, frame++), nullptr, s);
      if (std::abs(mean_luminance(renderer->read().denoised()) - settled) < 0.1 * std::abs(start - settled)) break;
    }
    RecordProperty(darker ? "frames_darker" : "frames_brighter", needed);
    // With the least weight of 0.04 alone it would take ln 0.1 / ln 0.96 = 56 frames.
    EXPECT_LE(needed, 2) << darker;
  }
}

}  // namespace
}  // namespace fb::render
