#include "host/game/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "render/passes/settings.h"

namespace fb::host {
namespace {

class PresetsTest : public testing::Test {
 protected:
  PresetsTest() {
    render::register_render_cvars(console);
    console.add_cvar("r_target_ms", "-1", "");
    console.add_cvar("r_cpu_pixels", "129600", "");
    register_presets(console, [this] { ++measurements; });
  }
  con::Console console;
  int measurements = 0;
};

TEST_F(PresetsTest, EachIsInForceOnceItIsChosenAndNoLongerWhenASettingChanges) {
  EXPECT_EQ(preset_in_force(console), nullptr);
  EXPECT_TRUE(presets_untouched(console));
  for (const Preset& preset : presets()) {
    console.execute(std::string("preset ") + preset.name);
    ASSERT_NE(preset_in_force(console), nullptr) << preset.name << ": a cvar does not take its value";
    EXPECT_STREQ(preset_in_force(console)->name, preset.name);
    EXPECT_EQ(console.cvar("r_preset").string(), preset.name);
    EXPECT_FALSE(presets_untouched(console));
  }
  console.execute("r_spp 3");
  EXPECT_EQ(preset_in_force(console), nullptr);
}

TEST_F(PresetsTest, AnUnknownOneChangesNothing) {
  console.execute("preset splendid");
  EXPECT_TRUE(presets_untouched(console));
  console.execute("preset auto");
  EXPECT_EQ(measurements, 1);
}

TEST(PresetFor, AWindowAndADeviceHaveTheLastThatIsDrawnAsItIsMeant) {
  const uvec2 hd(1280, 720), uhd(3840, 2160);
  const auto name = [](double speed, uvec2 window) { return std::string(preset_for(speed, window).name); };
  EXPECT_EQ(name(100, hd), "potato");
  EXPECT_EQ(name(299, hd), "potato");
  EXPECT_EQ(name(301, hd), "lavapipe") << "30000 pixels in 100 ms";
  EXPECT_EQ(name(14000, hd), "lavapipe");
  EXPECT_EQ(name(15000, hd), "balanced") << "a quarter of 1280x720 in 16 ms";
  EXPECT_EQ(name(15000, uhd), "lavapipe");
  EXPECT_EQ(name(1e6, uhd), "beautiful") << "the reference is chosen by hand alone";
}

TEST(DeviceSpeed, IsTheMedianOfTwoSecondsWithoutTheFirstFrames) {
  const Preset& lavapipe = *find_preset("lavapipe");
  DeviceSpeed speed;
  double now = 5.0;
  for (int i = 0; i < 8; ++i) speed.add(lavapipe, 100000.0, 1000.0, now += 1.0);
  EXPECT_FALSE(speed.measured()) << "pipelines are made";
  for (int i = 0; i < 19; ++i) speed.add(lavapipe, 100000.0, i % 4 == 0 ? 400.0 : 100.0, now += 0.1);
  EXPECT_FALSE(speed.measured()) << "1.9 seconds";
  for (int i = 0; i < 12; ++i) speed.add(lavapipe, 100000.0, 100.0, now += 0.1);
  ASSERT_TRUE(speed.measured());
  EXPECT_DOUBLE_EQ(*speed.measured(), 1000.0);
}

TEST(DeviceSpeed, ASlowDeviceHasFiveFramesAtLeast) {
  DeviceSpeed speed;
  double now = 0.0;
  for (int i = 0; i < 8 + 4; ++i) speed.add(*find_preset("lavapipe"), 1000.0, 4000.0, now += 4.0);
  EXPECT_FALSE(speed.measured());
  speed.add(*find_preset("lavapipe"), 1000.0, 4000.0, now += 4.0);
  EXPECT_TRUE(speed.measured());
}

class PresetChooserTest : public PresetsTest {
 protected:
  // Frames for so long, of a device that renders so many pixels of `lavapipe` in a millisecond; what was said.
  std::string draw(double speed, double seconds) {
    std::string said;
    for (const double end = now + seconds; now < end; now += 0.1) {
      const Preset* preset = preset_in_force(console);
      const double cost = preset ? preset->cost : 1.0;
      said += chooser.add(50000.0, 50000.0 * cost / speed, uvec2(1280, 720), now);
    }
    return said;
  }
  std::string in_force() const {
    const Preset* preset = preset_in_force(console);
    return preset ? preset->name : "none";
  }
  PresetChooser chooser{console};
  double now = 1.0;
};

TEST_F(PresetChooserTest, WhatWasMeasuredUnderLoadDoesNotStay) {
  EXPECT_TRUE(chooser.asked());
  chooser.begin(*find_preset("lavapipe"));
  EXPECT_THAT(draw(100, 3.5), testing::HasSubstr("preset potato: measured"));
  EXPECT_EQ(in_force(), "potato");
  EXPECT_EQ(draw(100, 60), "") << "it fits";
  EXPECT_EQ(draw(320, 60), "") << "hardly more than another needs";
  EXPECT_THAT(draw(600, 30), testing::HasSubstr("preset lavapipe: what was measured no longer fits"));
  EXPECT_EQ(in_force(), "lavapipe");
  EXPECT_EQ(draw(600, 60), "");
  EXPECT_THAT(draw(100, 30), testing::HasSubstr("preset potato"));
}

TEST_F(PresetChooserTest, OneBusyMomentChangesNothing) {
  chooser.begin(*find_preset("lavapipe"));
  draw(600, 15);
  EXPECT_EQ(in_force(), "lavapipe");
  EXPECT_EQ(draw(100, 8), "");
  EXPECT_EQ(draw(600, 60), "");
}

TEST_F(PresetChooserTest, TheNextStartMeasuresAgainAndThePlayersChoiceStays) {
  chooser.begin(*find_preset("lavapipe"));
  draw(100, 4);
  EXPECT_EQ(console.cvar("r_preset").string(), "auto");
  PresetChooser next(console);  // the configuration holds the same
  EXPECT_TRUE(next.asked());
  next.begin(*find_preset("lavapipe"));
  EXPECT_EQ(in_force(), "potato") << "measured with what was chosen";
  console.execute("preset balanced");
  EXPECT_EQ(draw(100, 60), "");
  EXPECT_EQ(in_force(), "balanced");
  EXPECT_FALSE(PresetChooser(console).asked());
}

TEST_F(PresetChooserTest, SettingsThatThePlayerChangesAreTheirOwn) {
  chooser.begin(*find_preset("lavapipe"));
  draw(600, 4);
  console.execute("r_bounces 3");
  EXPECT_EQ(draw(100, 60), "");
  EXPECT_EQ(console.cvar("r_bounces").value(), 3.0f);
  EXPECT_EQ(console.cvar("r_preset").string(), "");
  EXPECT_FALSE(PresetChooser(console).asked());
}

}  // namespace
}  // namespace fb::host
