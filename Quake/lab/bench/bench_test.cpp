// bench on scenes in code: what it measures agrees with itself and with arithmetic.
#include "lab/content_key.h"
#include "lab/bench/bench_job.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "base/test_directory.h"
#include "lab/bench/bench_report.h"
#include "lab/bench/test_bench.h"

namespace fb::lab {
namespace {

TEST_F(BenchTest, RepeatsToTheBit) {
  const View view = view_of("cbox", {0, 3, 0});
  const auto references = references_of(view, 64);
  const auto a = run(view, references, {configuration("pt", 1), configuration("again", 1)}, 2);
  const auto b = run(view, references, {configuration("pt", 1)}, 2);
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(a.configurations[0].frames.at(1, i).errors.mse, b.configurations[0].frames.at(1, i).errors.mse);
    EXPECT_EQ(a.configurations[0].frames.at(1, i).errors.mse, a.configurations[1].frames.at(1, i).errors.mse);
  }
  EXPECT_EQ(a.configurations[0].windows.size(), 1u) << "no warm-up: cold alone";
}

TEST_F(BenchTest, AViewThatMovesHasAReferenceAFrame) {
  const View view = view_of("moving", {3, 5, 2});
  EXPECT_FALSE(view.still);
  ASSERT_EQ(view.snapshots.size(), 5u);
  const auto references = references_of(view, 64);
  ASSERT_EQ(references.size(), 3u);
  const auto result = run(view, references, {configuration("pt", 1)}, 2);
  const auto& frames = result.configurations[0].frames;
  EXPECT_FALSE(frames.at(0, 1).measured);
  EXPECT_TRUE(frames.at(0, 2).measured);
  ASSERT_EQ(result.configurations[0].windows.size(), 1u);
  EXPECT_TRUE(result.configurations[0].windows[0].window.warm);
}

TEST_F(BenchTest, FramesMeetTheirOwnReferences) {
  // Without reflections there is no noise: no error against the own reference, some against another frame's.
  const View view = view_of("candles_flicker", {3, 5, 2});
  render::RenderSettings settings;
  settings.jitter = 0;
  settings.bounces = 0;
  const auto references = *make_references(view, *device_, settings, {"pt", 32, kWidth, kHeight, "", true});
  const auto right = run(view, references, {{"pt", settings}}, 1);
  const auto wrong = run(view, {references[2], references[2], references[2]}, {{"pt", settings}}, 1);
  for (std::uint32_t i = 2; i < 5; ++i) EXPECT_LT(right.configurations[0].frames.at(0, i).errors.mse, 1e-9);
  EXPECT_GT(wrong.configurations[0].frames.at(0, 2).errors.mse, 1e-6);
}

TEST_F(BenchTest, ReferencesAreKeptByTheirContent) {
  const TestDirectory directory;
  const auto& folder = directory.path();
  const View view = view_of("cbox", {0, 0, 0}), other = view_of("one_light", {0, 0, 0});
  const auto files = [&] {
    return std::ranges::count_if(std::filesystem::recursive_directory_iterator(folder),
                                 [](const auto& entry) { return entry.is_regular_file(); });
  };
  const auto made = references_of(view, 64, folder.string());
  EXPECT_EQ(files(), 1);
  const auto kept = references_of(view, 64, folder.string());
  EXPECT_EQ(files(), 1);
  ASSERT_EQ(made[0].mean.pixels.size(), kept[0].mean.pixels.size());
  EXPECT_EQ(made[0].mean.pixels[77], kept[0].mean.pixels[77]);
  EXPECT_EQ(made[0].variance[77], kept[0].variance[77]);
  references_of(view, 96, folder.string());
  references_of(other, 64, folder.string());
  EXPECT_EQ(files(), 3) << "other samples, another scene: other references";
}

TEST_F(BenchTest, TheKeyIsOfWhatIsSeen) {
  const scene::FrameSnapshot plain = view_of("cbox", {0, 0, 0}).snapshots[0];
  const std::uint64_t key = content_key(plain);
  const auto changed = [&](const auto& change) {
    scene::FrameSnapshot snapshot = plain;
    scene::Assets assets = *plain.assets;
    change(snapshot, assets);
    snapshot.assets = std::make_shared<scene::Assets>(std::move(assets));
    return content_key(snapshot) != key;
  };
  using scene::Assets, scene::FrameSnapshot;
  EXPECT_FALSE(changed([](FrameSnapshot&, Assets&) {})) << "a copy looks the same";
  EXPECT_FALSE(changed([](FrameSnapshot& s, Assets&) { s.frame += 5; }));
  EXPECT_TRUE(changed([](FrameSnapshot& s, Assets&) { s.instances[0].transform[3].x += 1; }));
  EXPECT_TRUE(changed([](FrameSnapshot& s, Assets&) { s.camera.angles.y += 1; }));
  EXPECT_TRUE(changed([](FrameSnapshot& s, Assets&) { s.ambient.y += 1; }));
  EXPECT_TRUE(changed([](FrameSnapshot& s, Assets&) { s.sky.color.x += 1; }));
  EXPECT_TRUE(changed([](FrameSnapshot& s, Assets&) { s.liquid_opacity.water = 0.5f; }));
  EXPECT_TRUE(changed([](FrameSnapshot&, Assets& a) { a.materials[0].base_color.y *= 0.5f; }));
  EXPECT_TRUE(changed([](FrameSnapshot& s, Assets&) { s.sky.suns.emplace_back(); }));
  EXPECT_FALSE(changed([](FrameSnapshot&, Assets& a) { a.materials[0].index = 1.5f; })) << "nothing is behind it";
  EXPECT_TRUE(changed([](FrameSnapshot&, Assets& a) { a.meshes[0].positions[0].z += 1; }));
  const auto in_style = [](FrameSnapshot& s, Assets& a, bool switched) {
    a.materials[0].cast_style = 3;
    a.materials[0].switched = switched;
    s.light_styles[3] = 0.5f;
  };
  EXPECT_TRUE(changed([&](FrameSnapshot& s, Assets& a) { in_style(s, a, true); }));
  EXPECT_FALSE(changed([&](FrameSnapshot& s, Assets& a) { in_style(s, a, false); })) << "its light has no style";
  EXPECT_FALSE(changed([](FrameSnapshot&, Assets& a) {
    a.materials[0].switched = true;
    a.materials[0].cast_style = 200;
  })) << "there is no such style";
  const auto key_of_filled = [&](float index) {
    scene::FrameSnapshot snapshot = plain;
    auto assets = std::make_shared<scene::Assets>(*plain.assets);
    assets->materials[0].flags |= scene::kMaterialDielectric;
    assets->materials[0].index = index;
    snapshot.assets = assets;
    return content_key(snapshot);
  };
  EXPECT_NE(key_of_filled(1.33f), key_of_filled(1.5f));
}

TEST_F(BenchTest, AHeldFrameStandsStill) {
  const View view = view_of("moving", {4, 9, 3, true});
  EXPECT_TRUE(view.still);
  ASSERT_EQ(view.snapshots.size(), 1u);
  const scene::FrameSnapshot first = view.at(1, 0), later = view.at(1, 5);
  EXPECT_EQ(content_key(first), content_key(later));
  EXPECT_EQ(first.frame, 9u) << "frames count up over the runs";
  EXPECT_EQ(later.frame, 14u);
  EXPECT_TRUE(first.cut);
  EXPECT_FALSE(later.cut);
  EXPECT_GT(later.time, later.prev_time);
  for (const auto& instance : later.instances) EXPECT_EQ(instance.transform, instance.prev_transform);
  // One frame on, something has moved.
  auto source = code_scene("moving", 60);
  const auto next = collect_view(**source, {5, 5, 0, true});
  EXPECT_NE(content_key(next->snapshots[0]), content_key(first));
}

TEST_F(BenchTest, RefusesWhatCannotBe) {
  auto source = code_scene("moving", 60);
  const auto early = collect_view(**source, {1, 3, 2});
  ASSERT_FALSE(early.ok());
  EXPECT_THAT(early.error().message, testing::HasSubstr("--warmup 2"));
  const View view = view_of("cbox", {0, 0, 0});
  BenchJob job;
  job.configurations = {configuration("pt", 1)};
  job.width = job.height = 8;
  job.quiet = true;
  const auto result = run_bench(*device_, view, references_of(view, 32), job);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, testing::HasSubstr("32x24"));
}

}  // namespace
}  // namespace fb::lab
