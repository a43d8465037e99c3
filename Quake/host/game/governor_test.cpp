#include "host/game/governor.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "base/rng.h"
#include "console/console.h"

namespace fb::host {
namespace {

using testing::HasSubstr;

// A device that takes 8 ms for a frame, and more for pixels: `full(now)` ms for a whole picture. Times scatter by 4%.
struct Drawn {
  int frames = 0, held = 0, changes = 0;
  double mean_scale = 0.0;
};
Drawn draw(Governor& governor, double target, double seconds, const std::function<double(double)>& full,
           float most = 1.0f) {
  Rng rng(7);
  Drawn drawn;
  int step = -1;
  for (double now = 0.0; now < seconds; ++drawn.frames) {
    governor.follow(target, most);
    const float scale = governor.scale(most);
    EXPECT_LE(scale, most);
    if (step >= 0 && step != governor.step()) {
      ++drawn.changes;
      EXPECT_TRUE(governor.changed());
    }
    step = governor.step();
    const double scatter = 1.0 + 0.08 * (static_cast<double>(rng.uniform()) - 0.5);
    const double work = 8.0 + full(now) * static_cast<double>(scale) * static_cast<double>(scale) * scatter;
    const double whole = std::max(work, governor.shortest());
    now += 1e-3 * whole;
    drawn.held += std::abs(whole - target) <= 0.15 * target ? 1 : 0;
    drawn.mean_scale += static_cast<double>(scale);
    governor.add(step, work, 0.0, whole, now);
  }
  drawn.mean_scale /= drawn.frames;
  return drawn;
}

TEST(Governor, HoldsTheTimeThatIsAskedForWhateverIsInView) {
  // A walk through rooms of which some take three times as long as others, and corners that are turned within a second.
  const auto rooms = [](double now) {
    return 400.0 * (1.0 + 0.5 * std::sin(0.7 * now) + (std::fmod(now, 11.0) < 4.0 ? 0.8 : 0.0));
  };
  for (const double target : {100.0, 150.0, 300.0}) {
    Governor governor;
    const Drawn drawn = draw(governor, target, 120.0, rooms);
    EXPECT_GT(drawn.held, 0.95 * drawn.frames) << target;
    EXPECT_LT(drawn.changes, 120) << target;  // less than once a second
    EXPECT_GT(drawn.mean_scale, 0.8 * std::sqrt((target - 8.0) / 700.0)) << target << ": it leaves no time unused";
    EXPECT_THAT(governor.report(), HasSubstr("ms a frame: 9"));
  }
}

TEST(Governor, RendersAllOfAPictureThatTakesLittle) {
  Governor governor;
  const Drawn drawn = draw(governor, 100.0, 60.0, [](double) { return 20.0; });
  EXPECT_EQ(governor.scale(1.0f), 1.0f);
  EXPECT_GT(drawn.held, 0.95 * drawn.frames) << "and waits for the rest of the time";

  Governor fast;
  const Drawn short_frames = draw(fast, 40.0, 60.0, [](double) { return 10.0; });
  EXPECT_GT(short_frames.frames, 60 * 50) << "which is not worth it where frames are short";
  EXPECT_THAT(fast.report(), HasSubstr("40 ms a frame: 100.0% of"));
}

TEST(Governor, OneFrameThatTakesLongChangesNothing) {
  Governor governor;
  draw(governor, 100.0, 30.0, [](double) { return 300.0; });
  const int step = governor.step();
  governor.add(step, 2000.0, 0.0, 2000.0, 32.0);
  EXPECT_EQ(governor.step(), step);
  for (int i = 0; i < 2; ++i) governor.add(governor.step(), 300.0, 0.0, 300.0, 33.0 + i);
  EXPECT_GT(governor.step(), step) << "two do, at once";
}

TEST(Governor, KeepsToTheLargestScaleThatIsAllowed) {
  Governor governor;
  draw(
      governor, 100.0, 30.0, [](double) { return 20.0; }, 0.4f);
  EXPECT_EQ(governor.scale(0.4f), 0.4f);
  for (int i = 0; i < 2; ++i) governor.add(governor.step(), 190.0, 0.0, 190.0, 40.0);
  EXPECT_TRUE(governor.changed());
  governor.follow(0.0, 0.4f);
  EXPECT_EQ(governor.scale(0.7f), 0.7f) << "at rest";
  EXPECT_EQ(governor.shortest(), 0.0);
  EXPECT_FALSE(governor.changed());
  EXPECT_THAT(governor.report(), HasSubstr("rests"));
}

TEST(Governor, TheLeastPictureIsStillOne) {
  Governor governor;
  draw(governor, 20.0, 10.0, [](double) { return 1e5; });
  EXPECT_GT(governor.scale(1.0f), 0.1f);
}

// What the window takes whatever is rendered is no reason to render next to nothing, and tells what room is left.
TEST(Governor, StarvesNoPictureForWhatPixelsHaveNoPartIn) {
  const auto settled = [](double fixed, double whole) {
    Governor governor;
    double now = 0.0, pixels = 0.0;
    for (int i = 0; i < 200; ++i) {
      governor.follow(100.0, 1.0f);
      pixels = whole * std::pow(static_cast<double>(governor.scale(1.0f)), 2);
      governor.add(governor.step(), fixed + pixels, fixed, fixed + pixels, now += 0.1);
    }
    return fixed + pixels;
  };
  EXPECT_GT(settled(150.0, 200.0), 160.0) << "the aim cannot be reached: the least picture would take 156";
  for (const double fixed : {0.0, 20.0, 50.0}) {
    EXPECT_LT(settled(fixed, 400.0), 104.0) << fixed;
    EXPECT_GT(settled(fixed, 400.0), 75.0) << fixed;
  }
}

TEST(Governor, ByDefaultItHoldsTenFramesASecondInAWindowOnACpu) {
  con::Console console;
  Governor governor;
  register_governor(console, governor);
  EXPECT_EQ(target_milliseconds(console, true, true), 100.0);
  EXPECT_EQ(target_milliseconds(console, false, true), 0.0);
  EXPECT_EQ(target_milliseconds(console, true, false), 0.0);
  console.set("r_target_ms", "250");
  EXPECT_EQ(target_milliseconds(console, false, false), 250.0);
  console.set("r_target_ms", "0");
  EXPECT_EQ(target_milliseconds(console, true, true), 0.0);
}

}  // namespace
}  // namespace fb::host
