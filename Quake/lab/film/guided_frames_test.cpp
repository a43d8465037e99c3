// lab/film/guided_frames.h: when a picture goes on, when it begins anew, and what it then keeps.
#include "lab/film/guided_frames.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "lab/bench/bench_view.h"
#include "lab/frame_source.h"
#include "lab/reference/replicates.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

class GuidedFramesSequences : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 32, kHeight = 24;
  static View view_of(const std::string& scene) {
    auto source = code_scene(scene, 60);
    EXPECT_TRUE(source.ok());
    auto view = collect_view(**source, {0, 1, 0, true});
    EXPECT_TRUE(view.ok());
    return std::move(*view);
  }
  static render::RenderSettings settings_of(const std::string& estimator) {
    render::RenderSettings settings;
    settings.estimator = estimator;
    settings.jitter = 0;
    settings.bounces = 3;
    settings.spp = 2;
    settings.deterministic = 1;
    settings.mir_split = 100;  // so that a small picture has leaves
    return settings;
  }
  static std::vector<vec3> shown(render::Renderer& renderer) {
    return picture_of(renderer.read().linear(), renderer.render_size()).pixels;
  }
};

TEST_F(GuidedFramesSequences, WhileNothingMovesFramesAreOnePicture) {
  const View view = view_of("cbox");
  for (const char* estimator : {"mir", "mir_nee"}) {
    const render::RenderSettings settings = settings_of(estimator);
    const auto shows = make_renderer(settings, kWidth, kHeight), waits = make_renderer(settings, kWidth, kHeight);
    GuidedFrames frames;
    for (std::uint32_t k = 0; k < 7; ++k) {
      scene::FrameSnapshot now = view.at(0, 0);
      now.cut = k == 0;
      now.time += k;  // nothing shows it
      frames.render(*shows, settings, now);
      EXPECT_EQ(frames.samples(), 2 * (k + 1));
    }
    // The same iterations, of 2, 2, 2, 2, 4, 2 (of 8) samples, with no picture between: showing one changes nothing.
    render::RenderSettings single = settings_of_samples(settings);
    scene::FrameSnapshot snapshot = view.at(0, 0);
    std::uint32_t iteration = 0;
    for (const std::uint32_t samples : {2u, 2u, 2u, 2u, 4u, 2u}) {
      waits->begin_iteration(iteration, iteration == 5 ? 8 : samples);
      ++iteration;
      for (std::uint32_t k = 0; k < samples; ++k, ++snapshot.frame) {
        waits->restart_accumulation();
        waits->render(snapshot, nullptr, single);
        snapshot.cut = false;
      }
    }
    waits->end_iterations();
    waits->render(snapshot, nullptr, single);
    EXPECT_EQ(shown(*shows), shown(*waits)) << estimator;
  }
}

// Other light, from another place: the guide of the former picture draws the first frame's paths, and their densities
// are those that are asked.
TEST_F(GuidedFramesSequences, WhatMovesBeginsAnewWithTheGuideItHas) {
  const View view = view_of("cbox");
  const render::RenderSettings settings = settings_of("mir");
  const auto renderer = make_renderer(settings, kWidth, kHeight), fresh = make_renderer(settings, kWidth, kHeight);
  GuidedFrames frames, others;
  scene::FrameSnapshot moved = view.at(0, 0);
  moved.cut = false;
  for (int k = 0; k < 16; ++k) frames.render(*renderer, settings, moved);
  EXPECT_EQ(frames.samples(), 32u);
  moved.camera.position.x += 4;
  for (int k = 0; k < 3; ++k) {
    frames.render(*renderer, settings, moved);
    others.render(*fresh, settings, moved);
    EXPECT_EQ(frames.samples(), 2u * (k + 1)) << "a picture of its own";
  }
  // Its paths find light at once, where those of a first frame without a guide go by chance.
  std::uint64_t kept = 0, without = 0, wrong = 0, vertices = 0;
  const std::string report = renderer->iterations_report(), of_fresh = fresh->iterations_report();
  ASSERT_EQ(std::sscanf(report.c_str(), "%lu paths stored", &kept), 1) << report;
  ASSERT_EQ(std::sscanf(of_fresh.c_str(), "%lu paths stored", &without), 1) << of_fresh;
  std::printf("paths that brought light: %lu with the guide, %lu without\n", kept, without);
  EXPECT_GT(kept, without + without / 4);
  const std::size_t at = report.find("densities of ");
  ASSERT_NE(at, std::string::npos) << report;
  ASSERT_EQ(std::sscanf(report.c_str() + at, "densities of %lu of %lu", &wrong, &vertices), 2) << report;
  EXPECT_GT(vertices, 200u);
  EXPECT_LE(wrong, 1u);
}

TEST_F(GuidedFramesSequences, TimeCountsWhereItShows) {
  scene::FrameSnapshot snapshot = view_of("cbox").at(0, 0);
  EXPECT_FALSE(shows_time(snapshot));
  const auto with = [&](const auto& change) {
    scene::Material material;
    change(material);
    const auto assets = std::make_shared<scene::Assets>();
    assets->materials = {scene::Material(), material};
    snapshot.assets = assets;
    return shows_time(snapshot);
  };
  EXPECT_FALSE(with([](scene::Material&) {}));
  EXPECT_TRUE(with([](scene::Material& m) { m.flags = scene::kMaterialWarp; }));
  EXPECT_TRUE(with([](scene::Material& m) { m.frames.resize(2); }));
  snapshot.assets = nullptr;
  EXPECT_FALSE(shows_time(snapshot));
  snapshot.sky.mode = scene::SkyMode::kLayers;
  EXPECT_TRUE(shows_time(snapshot));
}

}  // namespace
}  // namespace fb::lab
