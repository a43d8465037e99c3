#include "lab/timedemo/timedemo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/rng.h"

namespace fb::lab {
namespace {

using testing::HasSubstr;

// Frames of 10 ms and now and then 50; every time `factor` times as long, with a noise of 5%.
TimedRun run_of(int frames, double factor, std::uint64_t seed) {
  TimedRun run;
  Rng rng(seed);
  for (int i = 0; i < frames; ++i) {
    const double ms = factor * (i % 40 == 39 ? 50 : 10) * rng.uniform(0.95f, 1.05f);
    run.add({static_cast<std::uint64_t>(i + 3), 0.1 * i, ms, 0.5 * ms, ms},
            {{"gbuffer", false, 0.2 * ms}, {"paths", true, 0.6 * ms}});
    run.seconds += 1e-3 * ms;
  }
  run.frames = frames;
  return run;
}

Timedemos file_of(double factor, int runs, std::uint64_t seed) {
  Timedemos t;
  t.complete = true;
  t.manifest = {"fullbright 1",      "optimised", "a device", "a driver", "2026-01-01T00:00:00Z", 64, 36, 2,
                {{"r_bounces", "3"}}};
  TimedDemo& demo = t.demo("hub.dem");
  demo.hash = "12ab";
  for (int i = 0; i < runs; ++i) demo.runs.push_back(run_of(200, factor, seed + static_cast<std::uint64_t>(i)));
  return t;
}

TEST(Timedemo, FiguresOfFramesAreThoseOfTheirDefinitions) {
  TimedRun run;
  // 1 to 200 ms in an order of its own.
  for (int i = 0; i < 200; ++i) run.add({0, 0, 1.0 + (i * 77) % 200, 0, 0}, {});
  const FrameFigures f = frame_figures(run);
  EXPECT_DOUBLE_EQ(f.mean, 100.5);
  EXPECT_DOUBLE_EQ(f.p50, 100.5);
  EXPECT_DOUBLE_EQ(f.p99, 1 + 0.99 * 199);
  EXPECT_DOUBLE_EQ(f.low_1, 2000.0 / (200 + 199)) << "two frames of 200";
  EXPECT_DOUBLE_EQ(f.low_01, 5.0) << "at least one frame";
  ASSERT_EQ(f.worst.size(), kWorstFrames);
  for (std::size_t i = 0; i < kWorstFrames; ++i) EXPECT_EQ(run.times[f.worst[i]].whole, 200.0 - static_cast<double>(i));
  EXPECT_EQ(frame_figures(TimedRun()).worst.size(), 0u);
}

TEST(Timedemo, APassThatAFrameLacksTookNoTime) {
  TimedRun run;
  run.add({}, {{"a", false, 1.0}});
  run.add({}, {{"b", true, 2.0}, {"b", true, 3.0}});
  ASSERT_EQ(run.passes.size(), 2u);
  EXPECT_EQ(run.passes[0].milliseconds, (std::vector<double>{1, 0}));
  EXPECT_EQ(run.passes[1].milliseconds, (std::vector<double>{0, 5}));
}

TEST(Timedemo, AFileKeepsWhatItWasGiven) {
  const Timedemos t = file_of(1, 2, 1);
  const auto path = (std::filesystem::temp_directory_path() / "fullbright_timedemos_test.json").string();
  std::ofstream(path) << timedemos_json(t);
  const auto read = read_timedemos(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(timedemos_json(*read), timedemos_json(t));
  EXPECT_EQ(read->manifest.settings.at("r_bounces"), "3");
  std::ofstream(path) << "{\"format\": \"another\"}";
  EXPECT_THAT(read_timedemos(path).error().message, HasSubstr("no file of scr_timedemo_json"));
  std::ofstream(path) << "{\"format\": \"fullbright timedemos 1\"}";
  EXPECT_THAT(read_timedemos(path).error().message, HasSubstr("complete"));
  std::ofstream(path) << "{";
  EXPECT_THAT(read_timedemos(path).error().message, HasSubstr("json: parse error at line 1")) << "and no code";
  std::filesystem::remove(path);
  EXPECT_THAT(read_timedemos(path).error().message, HasSubstr(path));
}

TEST(Timedemo, ASpeedUpIsFoundAndItsIntervalHoldsIt) {
  const auto c = compare_timedemos(file_of(1, 4, 1), "A", file_of(0.8, 5, 50), "B");
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_NEAR(c->speed.value, 1.25, 0.01);
  EXPECT_LT(c->speed.interval.low, 1.25);
  EXPECT_GT(c->speed.interval.high, 1.25);
  EXPECT_GT(c->speed.interval.low, 1.2);
  EXPECT_LT(c->speed.interval.high, 1.3);
  EXPECT_THAT(c->sentence, HasSubstr("faster"));
  ASSERT_EQ(c->demos.front().passes.size(), 2u);
  EXPECT_NEAR(c->demos.front().passes[1].second.value, 1.25, 0.01);
  EXPECT_THAT(comparison_table(*c), HasSubstr("paths"));
}

TEST(Timedemo, EqualBuildsAreSeldomCalledDifferent) {
  // 95% intervals, runs that are each faster or slower as a whole: 400 pairs go wrong 20 times, give or take three
  // binomial standard errors.
  int wrong = 0;
  Rng rng(3);
  const auto noisy = [&](std::uint64_t seed) {
    Timedemos t = file_of(1, 0, 0);
    for (std::uint64_t i = 0; i < 4; ++i) {
      const double whole = std::exp(0.1 * (rng.uniform() + rng.uniform() + rng.uniform() - 1.5));
      t.demos.front().runs.push_back(run_of(40, whole, seed + i));
    }
    return t;
  };
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto c = compare_timedemos(noisy(1000 * i), "A", noisy(1000 * i + 500), "B");
    wrong += c->speed.interval.low > 1 || c->speed.interval.high < 1;
  }
  EXPECT_NEAR(wrong, 20, 13);
}

TEST(Timedemo, FewRunsSayNothingOfChance) {
  const auto c = compare_timedemos(file_of(1, 2, 1), "A", file_of(0.8, 9, 50), "B");
  ASSERT_TRUE(c);
  EXPECT_FALSE(c->speed.has_interval());
  EXPECT_NEAR(c->speed.value, 1.25, 0.01);
  EXPECT_THAT(c->sentence, HasSubstr("95% intervals want 4 runs; there are 2"));
  EXPECT_THAT(timedemo_lines(file_of(1, 2, 1)).front(), HasSubstr("want 4 runs; there are 2: scr_timedemo_runs"));
  EXPECT_THAT(timedemo_lines(file_of(1, 4, 1)).front(), HasSubstr("["));
}

TEST(Timedemo, UnlikeFilesAreRefusedWithTheReason) {
  const Timedemos a = file_of(1, 1, 1);
  const auto why = [&](const auto& change) {
    Timedemos b = a;
    change(b);
    const auto c = compare_timedemos(a, "A", b, "B");
    return c ? std::string() : c.error().message;
  };
  EXPECT_EQ(why([](Timedemos&) {}), "");
  EXPECT_THAT(why([](Timedemos& b) { b.demos[0].hash = "other"; }), HasSubstr("another demo"));
  EXPECT_THAT(why([](Timedemos& b) { b.demos[0].name = "other.dem"; }), HasSubstr("not in B"));
  EXPECT_THAT(why([](Timedemos& b) { b.demos[0].runs[0].frames = 7; }), HasSubstr("7 frames"));
  EXPECT_THAT(why([](Timedemos& b) { b.demos[0].runs[0].times[5].message = 99; }),
              HasSubstr("frame 5 shows message 99"));
  EXPECT_THAT(why([](Timedemos& b) { b.manifest.width = 65; }), HasSubstr("64x36"));
  EXPECT_THAT(why([](Timedemos& b) { b.complete = false; }), HasSubstr("to their end"));
  Timedemos b = a;
  b.manifest.device = "another";
  b.manifest.settings.clear();
  EXPECT_THAT(compare_timedemos(a, "A", b, "B")->differences,
              testing::ElementsAre("device: a device and another", "r_bounces: 3 and its default"));
}

}  // namespace
}  // namespace fb::lab
