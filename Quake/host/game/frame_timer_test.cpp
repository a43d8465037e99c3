#include "host/game/frame_timer.h"

#include <gtest/gtest.h>

#include "console/console.h"

namespace fb::host {
namespace {

TEST(FrameTimer, NoFrameIsShorterThanTheShortest) {
  con::Console console;
  register_time_cvars(console);
  console.execute("host_framerate 0.00000001");
  const TimeSettings settings = read_time_settings(console);
  EXPECT_FLOAT_EQ(static_cast<float>(settings.frame_rate), 0.0001f);
  EXPECT_EQ(console.scrollback().latest(1).back().text,
            "host_framerate: 0.00000001 is not allowed (0, or 0.0001 to 1), so it is 0.0001 now.");
  console.execute("host_framerate 0");
  EXPECT_EQ(read_time_settings(console).frame_rate, 0.0) << "real time";
}

TEST(FrameTimer, UpTo72FramesASecondEachFrameIsATick) {
  FrameTimer timer;
  const FramePlan plan = timer.plan(0.02, {0.0, 0.0, 72.0});
  EXPECT_TRUE(plan.in_step);
  EXPECT_EQ(plan.ticks, 1);
  EXPECT_EQ(plan.seconds, 0.02);
  EXPECT_EQ(plan.tick_seconds, 0.02);
  EXPECT_EQ(timer.plan(3.0, {0.0, 0.0, 60.0}).tick_seconds, 0.1) << "a long frame is no long step";
  EXPECT_GT(timer.plan(0.0, {0.0, 0.0, 60.0}).tick_seconds, 0.0);
}

TEST(FrameTimer, AboveThatTicksAreOf72thsWhateverTheFrameRate) {
  for (const double fps : {75.0, 100.0, 144.0, 250.0, 1000.0, 20.0}) {
    FrameTimer timer;
    int ticks = 0;
    for (int i = 0; i < static_cast<int>(fps * 10.0); ++i) {
      const FramePlan plan = timer.plan(1.0 / fps, {0.0, 0.0, 250.0});
      EXPECT_FALSE(plan.in_step);
      EXPECT_EQ(plan.seconds, 1.0 / fps);
      EXPECT_EQ(plan.tick_seconds, FrameTimer::kTick);
      ticks += plan.ticks;
    }
    EXPECT_NEAR(ticks, 720, 1) << fps;
  }
}

TEST(FrameTimer, AGivenFrameRateMakesFramesTicks) {
  FrameTimer timer;
  for (const double passed : {0.0, 0.001, 5.0}) {
    const FramePlan plan = timer.plan(passed, {0.05, 0.0, 250.0});
    EXPECT_TRUE(plan.in_step);
    EXPECT_EQ(plan.ticks, 1);
    EXPECT_EQ(plan.seconds, 0.05);
    EXPECT_EQ(plan.tick_seconds, 0.05);
  }
}

TEST(FrameTimer, TimescaleComesBeforeFramerate) {
  FrameTimer timer;
  EXPECT_DOUBLE_EQ(timer.plan(0.02, {0.05, 0.5, 60.0}).tick_seconds, 0.01);
  FramePlan plan = timer.plan(0.02, {0.05, 0.5, 250.0});
  EXPECT_DOUBLE_EQ(plan.seconds, 0.01);
  EXPECT_EQ(plan.ticks, 1);
  EXPECT_DOUBLE_EQ(plan.tick_seconds, FrameTimer::kTick / 2) << "as often as ever, with less time in each";
}

TEST(DrawsAhead, NeverUnderAMenuOrTheConsole) {
  EXPECT_TRUE(draws_ahead(-1, true, false));
  EXPECT_FALSE(draws_ahead(-1, false, false));
  EXPECT_TRUE(draws_ahead(1, false, false));
  EXPECT_FALSE(draws_ahead(0, true, false));
  for (const float asked : {-1.0f, 0.0f, 1.0f})
    for (const bool demo : {true, false}) EXPECT_FALSE(draws_ahead(asked, demo, true)) << asked << demo;
}

}  // namespace
}  // namespace fb::host
