// The mixer: loudness by the closed formula, channels that override and make room, loops, ambient sounds, filters.
#include "audio/mixer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "audio/test_sounds.h"

namespace fb::audio {
namespace {

using command::Ambients;
using command::Loop;
using command::Scene;
using command::Start;
using command::Stop;
using command::StopAll;
using test::constant;
using test::sample_of;

constexpr std::uint32_t kRate = 44100;
constexpr int kPlayer = 1;
// Of a sample at half of full scale, halved again.
constexpr float kLevel = 0.25f;

class MixerTest : public ::testing::Test {
 protected:
  MixerTest() {
    scene_.right = vec3(0, -1, 0);
    scene_.entity = kPlayer;
    scene_.ambient_fade = 100.0f / 255.0f;
    mixer_.apply(scene_);
  }
  std::vector<float> mix(std::size_t frames) {
    std::vector<float> stereo(2 * frames);
    mixer_.mix(stereo);
    return stereo;
  }
  // Loudness left and right now: of the last of 600 frames, when gains have settled.
  Gains heard(std::size_t frames = 600) {
    const std::vector<float> stereo = mix(frames);
    return {stereo[2 * frames - 2] / kLevel, stereo[2 * frames - 1] / kLevel};
  }
  void start(int entity, int channel, const SamplePtr& sample, const vec3& origin = vec3(0.0f), float volume = 1.0f,
             float attenuation = 1.0f) {
    mixer_.apply(Start{sample, entity, channel, origin, volume, attenuation});
  }
  void look_from(const vec3& origin, const vec3& right) {
    scene_.origin = origin;
    scene_.right = right;
    mixer_.apply(scene_);
  }

  Mixer mixer_{kRate};
  Scene scene_;
};

void expect_gains(const Gains& gains, float left, float right, const std::string& what = "") {
  EXPECT_NEAR(gains.left, left, 1e-5f) << what;
  EXPECT_NEAR(gains.right, right, 1e-5f) << what;
}

// volume * (1 - distance * attenuation / 1000) * (1 +- cosine), never below 0.
TEST(Spatialize, IsTheClosedFormula) {
  const vec3 right(0, -1, 0);
  expect_gains(spatialize(vec3(0), right, vec3(0), 0.5f, 1.0f), 0.5f, 0.5f, "at the ear");
  expect_gains(spatialize(vec3(0), right, vec3(500, 0, 0), 1.0f, 1.0f), 0.5f, 0.5f, "ahead");
  expect_gains(spatialize(vec3(0), right, vec3(0, -250, 0), 1.0f, 1.0f), 0.0f, 1.5f, "right");
  expect_gains(spatialize(vec3(0), right, vec3(0, 250, 0), 1.0f, 1.0f), 1.5f, 0.0f, "left");
  expect_gains(spatialize(vec3(0), right, vec3(300, -400, 0), 0.8f, 0.5f), 0.6f * 0.2f, 0.6f * 1.8f, "aside");
  expect_gains(spatialize(vec3(10, 20, 30), right, vec3(10, 20, 1030), 1.0f, 1.0f), 0.0f, 0.0f, "at the end");
  expect_gains(spatialize(vec3(0), right, vec3(3000, 0, 0), 1.0f, 1.0f), 0.0f, 0.0f, "beyond");
  expect_gains(spatialize(vec3(0), right, vec3(9000, 0, 0), 1.0f, 0.0f), 1.0f, 1.0f, "without attenuation");
  expect_gains(spatialize(vec3(0), right, vec3(0, -200, 0), 1.0f, 3.0f), 0.0f, 0.8f, "static: 3 ends at 333 units");
  expect_gains(spatialize(vec3(0), vec3(0), vec3(0, -250, 0), 1.0f, 1.0f), 0.75f, 0.75f, "no direction");
}

TEST_F(MixerTest, LevelsOfTheMixAreTheFormulas) {
  start(2, 1, constant(4000), vec3(300, -400, 0), 0.8f, 0.5f);
  expect_gains(heard(), 0.12f, 1.08f);
  look_from(vec3(0, -400, 0), vec3(0, -1, 0));
  expect_gains(heard(), 0.8f * 0.85f, 0.8f * 0.85f, "after the listener moved");
}

// After a seek a sound is where it would be by now; one that has ended is not heard.
TEST_F(MixerTest, SoundsThatBeganAWhileAgoGoOnFromThere) {
  const auto start_aged = [this](const SamplePtr& sample, double age, const vec3& origin = vec3(0.0f)) {
    mixer_.apply(StopAll{});
    mixer_.apply(Start{sample, 2, 0, origin, 1.0f, 1.0f, age});
  };
  std::vector<std::int16_t> ramp(10000);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::int16_t>(3 * i);
  const SamplePtr once = sample_of(ramp), looped = sample_of(ramp, 4000);
  // Of the sample, read 1000 frames later, when the step of its beginning has fallen to nothing.
  const auto first_frame = [this] { return mix(1001)[2000] * 2.0f * 32768.0f / 3.0f - 1000.0f; };
  start_aged(once, 2500.0 / kRate);
  EXPECT_NEAR(first_frame(), 2500.0f, 0.05f);
  start_aged(once, 10000.0 / kRate);
  EXPECT_EQ(mixer_.counts().sounds, 0u) << "it has ended";
  start_aged(looped, 10000.0 / kRate);
  EXPECT_NEAR(first_frame(), 4000.0f, 0.05f) << "the loop's beginning";
  start_aged(looped, (10000.0 + 5 * 6000.0 + 37.0) / kRate);
  EXPECT_NEAR(first_frame(), 4037.0f, 0.05f);
  start_aged(once, 2500.0 / kRate, vec3(5000, 0, 0));
  look_from(vec3(5000, 0, 0), vec3(0.0f));
  EXPECT_NEAR(first_frame(), 2500.0f, 0.05f) << "the listener has come with the seek";
}

TEST_F(MixerTest, OwnSoundsComeFromNowhere) {
  start(kPlayer, 1, constant(4000), vec3(5000, 0, 0), 0.5f);
  expect_gains(heard(), 0.5f, 0.5f);
  scene_.entity = 7;
  mixer_.apply(scene_);
  EXPECT_TRUE(heard(1200).silent()) << "another view";
}

// Quake's mixer: the louder side of a sound of 8 bits is no louder than its volume.
TEST_F(MixerTest, EightBitsAreNotMadeLouderByDirection) {
  start(2, 1, constant(4000, false, 8), vec3(0, -250, 0));
  expect_gains(heard(), 0.0f, 1.0f);
  start(2, 1, constant(4000, false, 16), vec3(0, -250, 0));
  expect_gains(heard(), 0.0f, 1.5f);
}

TEST_F(MixerTest, GainsGoInALineWithoutSteps) {
  start(2, 1, constant(20000), vec3(500, 0, 0));
  heard();
  look_from(vec3(400, 0, 0), vec3(0, -1, 0));
  const std::vector<float> stereo = mix(1024);
  for (std::size_t i = 1; i < 1024; ++i) ASSERT_LT(std::abs(stereo[2 * i] - stereo[2 * i - 2]), 0.01f * kLevel) << i;
  EXPECT_NEAR(stereo[2046], 0.9f * kLevel, 1e-5f);
}

TEST_F(MixerTest, BeginsAtOnceAndEndsWithItsLastFrame) {
  start(2, 1, constant(700));
  const std::vector<float> stereo = mix(1000);
  for (std::size_t i = 0; i < 700; ++i) ASSERT_EQ(stereo[2 * i], kLevel) << i;
  for (std::size_t i = 700; i < 1000; ++i) ASSERT_EQ(stereo[2 * i], 0.0f) << i;
  EXPECT_EQ(mixer_.counts().sounds, 0u);
}

TEST_F(MixerTest, TheSameChannelOverrides) {
  start(2, 3, constant(5000), vec3(0), 0.25f);
  start(2, 3, constant(5000), vec3(0), 0.5f);
  expect_gains(heard(), 0.5f, 0.5f);
  EXPECT_EQ(mixer_.counts().sounds, 1u);
  start(2, 4, constant(5000), vec3(0), 0.125f);
  start(3, 3, constant(5000), vec3(0), 0.125f);
  expect_gains(heard(), 0.75f, 0.75f, "another channel, another entity");
}

TEST_F(MixerTest, ChannelZeroOverridesNothing) {
  start(2, 0, constant(5000), vec3(0), 0.25f);
  start(2, 0, constant(5000), vec3(0), 0.25f);
  EXPECT_EQ(mixer_.counts().sounds, 2u);
}

TEST_F(MixerTest, AnyChannelOverridesOneOfTheEntity) {
  start(kPlayer, 2, constant(5000), vec3(0), 0.25f);
  start(kPlayer, -1, constant(5000), vec3(0), 0.5f);
  expect_gains(heard(), 0.5f, 0.5f, "a menu's click ends the player's sound");
  start(kPlayer, -1, constant(5000), vec3(0), 1.0f);
  expect_gains(heard(), 1.0f, 1.0f);
}

TEST_F(MixerTest, OverridesEvenByWhatIsTooFarToBeHeard) {
  start(2, 1, constant(5000));
  start(2, 1, constant(5000), vec3(2000, 0, 0));
  EXPECT_TRUE(heard().silent());
}

TEST_F(MixerTest, WhatEndsFirstMakesRoom) {
  for (std::size_t i = 0; i < kDynamicChannels; ++i)
    start(10 + static_cast<int>(i), 1, constant(i == 40 ? 20000 : 30000), vec3(0), 1.0f / 256.0f);
  EXPECT_EQ(mixer_.counts().sounds, kDynamicChannels);
  start(500, 1, constant(30000), vec3(0), 0.25f);
  EXPECT_EQ(mixer_.counts().sounds, kDynamicChannels);
  expect_gains(heard(21000), 127.0f / 256.0f + 0.25f, 127.0f / 256.0f + 0.25f, "the short one is gone, no other");
}

TEST_F(MixerTest, OthersDoNotTakeTheListenersChannels) {
  for (std::size_t i = 0; i < kDynamicChannels; ++i) start(kPlayer, 0, constant(1000 + i), vec3(0), 1.0f / 256.0f);
  start(2, 1, constant(5000), vec3(0), 0.5f);
  expect_gains(heard(), 0.5f, 0.5f, "all are the player's: the monster is not heard");
  start(kPlayer, 0, constant(5000), vec3(0), 0.25f);
  expect_gains(heard(300), 0.5f - 1.0f / 256.0f + 0.25f, 0.5f - 1.0f / 256.0f + 0.25f, "another of the player's is");
}

TEST_F(MixerTest, StopEndsTheSoundOfEntityAndChannel) {
  start(2, 1, constant(5000), vec3(0), 0.25f);
  start(2, 2, constant(5000), vec3(0), 0.5f);
  mixer_.apply(Stop{2, 1});
  mixer_.apply(Stop{3, 2});
  expect_gains(heard(), 0.5f, 0.5f);
}

TEST_F(MixerTest, IdenticalSoundsAreSpread) {
  const SamplePtr click = sample_of([] {
    std::vector<std::int16_t> frames(6000, 0);
    frames[5000] = 16384;
    return frames;
  }());
  start(2, 1, click);
  start(3, 1, click);
  const std::vector<float> stereo = mix(6000);
  std::vector<std::size_t> clicks;
  for (std::size_t i = 0; i < 6000; ++i)
    if (stereo[2 * i] != 0.0f) clicks.push_back(i);
  ASSERT_EQ(clicks.size(), 2u) << "not one click, twice as loud";
  EXPECT_EQ(clicks[1], 5000u);
  EXPECT_GT(clicks[0], 5000u - 4410u);
  start(2, 1, click);
  mix(1);
  start(3, 1, click);
  const std::vector<float> later = mix(5200);
  EXPECT_NE(later[2 * 4999], 0.0f);
  EXPECT_NE(later[2 * 5000], 0.0f) << "one that begins later is not moved";
}

TEST_F(MixerTest, LoopsGoOnFromTheirStart) {
  std::vector<std::int16_t> frames(1000, 16384);
  for (std::size_t i = 0; i < 300; ++i) frames[i] = 8192;
  start(2, 1, sample_of(frames, 300));
  const std::vector<float> stereo = mix(5000);
  for (std::size_t i = 0; i < 5000; ++i) ASSERT_EQ(stereo[2 * i], i < 300 ? kLevel / 2 : kLevel) << i;
}

TEST_F(MixerTest, LoopsOfASampleAreOneVoiceWithTheSumOfTheirLoudness) {
  const SamplePtr fire = constant(900, true), wind = constant(700, true);
  mixer_.apply(Loop{fire, vec3(100, 0, 0), 0.25f, 1.0f});
  mixer_.apply(Loop{fire, vec3(0, -200, 0), 0.25f, 1.0f});
  mixer_.apply(Loop{wind, vec3(0, 0, 500), 0.5f, 1.0f});
  mixer_.apply(scene_);
  expect_gains(heard(), 0.225f + 0.25f, 0.225f + 0.4f + 0.25f);
  EXPECT_EQ(mixer_.counts().loops, 2u);
  EXPECT_EQ(mixer_.counts().sources, 3u);
  look_from(vec3(2000, 0, 0), vec3(0, -1, 0));
  EXPECT_TRUE(heard(1100).silent());
  look_from(vec3(100, 0, 0), vec3(0, -1, 0));
  EXPECT_NEAR(heard().right, 0.25f + 0.25f * (1 - 0.2236068f) * (1 + 0.8944272f) + 0.5f * (1 - 0.5099020f), 1e-5f);
}

TEST_F(MixerTest, StopAllEndsEverything) {
  start(2, 1, constant(5000));
  mixer_.apply(Loop{constant(900, true), vec3(0), 0.25f, 1.0f});
  mixer_.apply(scene_);
  mixer_.apply(StopAll{});
  EXPECT_TRUE(heard().silent());
  EXPECT_EQ(mixer_.counts().sounds + mixer_.counts().sources, 0u);
}

// ambient_fade 100: 100/255 of full volume a second, up and down.
TEST_F(MixerTest, AmbientSoundsFade) {
  mixer_.apply(Ambients{{constant(5000, true), constant(7000, true), nullptr, nullptr}});
  scene_.ambient_volumes = {0.3f, 0.0f, 0.0f, 0.0f};
  mixer_.apply(scene_);
  const float tenth = 0.1f * 100.0f / 255.0f;
  expect_gains(heard(kRate / 10), tenth, tenth);
  expect_gains(heard(kRate / 10), 2 * tenth, 2 * tenth);
  expect_gains(heard(kRate), 0.3f, 0.3f);
  scene_.ambient_volumes = {0.0f, 0.1f, 0.0f, 0.0f};
  mixer_.apply(scene_);
  expect_gains(heard(kRate / 10), 0.3f, 0.3f, "one fades out while the other fades in");
  expect_gains(heard(kRate), 0.1f, 0.1f);
}

TEST_F(MixerTest, VolumeAndClipping) {
  scene_.volume = 0.5f;
  mixer_.apply(scene_);
  start(2, 1, constant(9000));
  expect_gains(heard(), 0.5f, 0.5f);
  scene_.volume = 1.0f;
  mixer_.apply(scene_);
  for (int i = 3; i < 12; ++i) start(i, 1, constant(9000));
  expect_gains(heard(), 2.0f, 2.0f, "the sum is clipped at full scale, and halved");
}

TEST_F(MixerTest, MutedIsSilentAndTimeGoesOn) {
  start(2, 1, constant(3000));
  scene_.muted = true;
  mixer_.apply(scene_);
  EXPECT_TRUE(heard(2000).silent());
  scene_.muted = false;
  mixer_.apply(scene_);
  expect_gains(heard(600), 1.0f, 1.0f);
  EXPECT_TRUE(heard(600).silent()) << "it went on while it was not heard";
}

// Tones of a period of 441 frames, all of which something cuts or begins in its middle. Each moves by at most
// amplitude * 2 pi / 441 a frame, and what is cut falls by its value over the frames of kStepFade; a step would be as
// large as the value.
class ClickTest : public MixerTest {
 protected:
  static constexpr std::int16_t kAmplitude = 8192;
  static SamplePtr tone(std::size_t frames, double phase, bool loops = false) {
    std::vector<std::int16_t> values(frames);
    for (std::size_t i = 0; i < frames; ++i)
      values[i] = static_cast<std::int16_t>(
          std::lround(kAmplitude * std::sin(phase + 2.0 * std::numbers::pi * static_cast<double>(i) / 441.0)));
    return sample_of(std::move(values), loops ? std::optional<std::size_t>(0) : std::nullopt);
  }
  // Mixes, and holds every frame to the one before it. `tones`: how many sound or are cut, each as loud as it may be.
  void expect_no_step(double tones, const char* what) {
    const double amplitude = 0.5 * kAmplitude / 32768.0;
    const double most = tones * amplitude * (2.0 * std::numbers::pi / 441.0 + 1.0 / (kStepFade * kRate)) + 1e-4;
    ASSERT_LT(most, 0.3 * amplitude) << "or no step would be seen";
    double largest = 0.0;
    const std::vector<float> stereo = mix(300);
    for (std::size_t i = 0; i < stereo.size(); ++i) {
      largest = std::max(largest, std::abs(static_cast<double>(stereo[i] - before_[i % 2])));
      before_[i % 2] = stereo[i];
    }
    EXPECT_LT(largest, most) << what;
  }
  std::array<float, 2> before_{};
};

TEST_F(ClickTest, WhatIsCutFallsToNothing) {
  const auto begin = [&](int entity) {  // at a peak for the next frame, after 300 from a zero
    start(entity, 1, tone(44100, 2.0 * std::numbers::pi * (-300.0 / 441.0 + 0.25)), vec3(0));
  };
  const double first = 0.5 * kAmplitude / 32768.0;
  const auto settle = [&] {  // its own beginning is the file's step, and not looked at
    begin(2);
    const std::vector<float> stereo = mix(300);
    before_ = {stereo[598], stereo[599]};
    ASSERT_GT(std::abs(before_[0]), 0.9 * first);
  };
  settle();
  mixer_.apply(Stop{2, 1});
  expect_no_step(1.0, "a stop");
  settle();
  start(2, 1, tone(44100, 0.0));
  expect_no_step(2.0, "another sound on the same channel");
  settle();
  start(2, 1, tone(44100, 0.0), vec3(5000, 0, 0));
  expect_no_step(1.0, "another sound that is not heard");
  settle();
  mixer_.apply(StopAll{});
  expect_no_step(1.0, "the level's end");
  settle();
  for (std::size_t i = 0; i < kDynamicChannels; ++i) start(100 + static_cast<int>(i), 1, constant(44100, false, 16, 0));
  EXPECT_EQ(mixer_.counts().sounds, kDynamicChannels);
  start(999, 1, constant(44100, false, 16, 0));
  expect_no_step(1.0, "making room");
}

TEST_F(ClickTest, WhatBeginsInItsMiddleRises) {
  const double quarter = 0.5 * std::numbers::pi;
  mixer_.apply(Start{tone(44100, quarter), 2, 1, vec3(0), 1.0f, 1.0f, 441.0 / kRate});
  expect_no_step(1.0, "a sound that began a while ago");
  mixer_.apply(StopAll{});
  mix(300);
  before_ = {};
  mixer_.apply(Loop{tone(441, quarter, true), vec3(0), 1.0f, 1.0f});
  mixer_.apply(scene_);
  expect_no_step(1.0, "a level's loop");
  mixer_.apply(StopAll{});
  mix(300);
  before_ = {};
  mixer_.apply(Ambients{{tone(441, quarter, true), nullptr, nullptr, nullptr}});
  scene_.ambient_volumes = {1.0f, 0.0f, 0.0f, 0.0f};
  scene_.ambient_fade = 1e6f;
  mixer_.apply(scene_);
  expect_no_step(1.0, "an ambient sound at once as loud as wanted");
  mixer_.apply(Ambients{{tone(441, -quarter, true), nullptr, nullptr, nullptr}});
  expect_no_step(2.0, "another ambient sound");
}

TEST_F(ClickTest, TheSameSoundTwiceAtOnce) {
  std::vector<std::int16_t> rising(44100, kAmplitude);
  for (std::size_t i = 0; i < 441; ++i)
    rising[i] = static_cast<std::int16_t>(
        std::lround(kAmplitude * std::sin(0.5 * std::numbers::pi * static_cast<double>(i) / 441.0)));
  const SamplePtr sample = sample_of(std::move(rising));
  start(2, 1, sample);
  start(3, 1, sample);  // begins up to a tenth of a second further on
  expect_no_step(2.0, "the second one");
}

TEST_F(ClickTest, TheVolumeGoesInALine) {
  start(2, 1, constant(44100, false, 16, kAmplitude));
  const std::vector<float> stereo = mix(300);
  before_ = {stereo[598], stereo[599]};
  scene_.volume = 0.0f;
  mixer_.apply(scene_);
  expect_no_step(1.0, "volume 0");
}

// At strength 1 the filter is that of an exponential average which goes 1/12 of the way a frame at 44.1 kHz.
TEST(Underwater, MufflesByItsStrength) {
  for (const std::uint32_t rate : {22050u, 44100u, 96000u}) {
    Mixer mixer(rate);
    Scene scene;
    scene.underwater = 1.0f;
    mixer.apply(scene);
    std::vector<float> stereo(2 * rate);
    mixer.mix(stereo);  // the filter is there after a quarter of a second
    std::vector<std::int16_t> step(rate, 16384);
    mixer.apply(Start{sample_of(step), 0, 1, vec3(0), 1.0f, 1.0f});
    mixer.mix(stereo);
    const double frames = rate / 1000.0;  // of a millisecond
    const auto at = static_cast<std::size_t>(frames);
    const double expected = 1.0 - std::pow(11.0 / 12.0, 44.1 * (static_cast<double>(at) + 1) / frames);
    EXPECT_NEAR(stereo[2 * at] / kLevel, expected, 1e-3) << rate;
  }
}

TEST(Underwater, ComesAndGoesWithinAQuarterSecond) {
  Mixer mixer(kRate);
  mixer.apply(Start{constant(kRate, true), 0, 1, vec3(0), 1.0f, 1.0f});
  std::vector<float> stereo(2 * kRate);
  mixer.mix(stereo);
  Scene scene;
  scene.underwater = 1.0f;
  mixer.apply(scene);
  mixer.mix(stereo);
  for (std::size_t i = 0; i < kRate; ++i) ASSERT_NEAR(stereo[2 * i], kLevel, 1e-5f) << "an even sound stays even";
}

// The same commands and sizes give the same frames; other sizes of mixes differ only where gains change in them.
TEST(Mixing, IsDeterministic) {
  const auto run = [](std::size_t block) {
    Mixer mixer(kRate);
    std::vector<std::int16_t> noise(20000);
    Rng rng(5);
    for (std::int16_t& value : noise) value = static_cast<std::int16_t>(rng.next() >> 16u);
    const SamplePtr sample = sample_of(noise, 500);
    for (int i = 0; i < 20; ++i) mixer.apply(Start{sample, i, 0, vec3(i, 10, 0), 0.1f, 1.0f});
    std::vector<float> stereo(2 * 44000);
    for (std::size_t at = 0; at < stereo.size(); at += 2 * block)
      mixer.mix(std::span(stereo).subspan(at, std::min(2 * block, stereo.size() - at)));
    return stereo;
  };
  EXPECT_EQ(run(1024), run(1024));
  EXPECT_EQ(run(1024), run(333));
}

}  // namespace
}  // namespace fb::audio
