// The sound of a game from events to frames: cvars, commands, levels, loops, music, and two threads.
#include "audio/sound_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "audio/test_sounds.h"
#include "console/console.h"

namespace fb::audio {
namespace {

using ::testing::HasSubstr;

class SystemTest : public ::testing::Test {
 protected:
  SystemTest() {
    // Half of full scale, a second long, each at 44.1 kHz.
    const formats::testing::WaveFile plain{.rate = 44100, .samples = std::vector<int>(44100, 16384)};
    formats::testing::WaveFile loop = plain;
    loop.cue = 0;
    files_.add_sound("misc/menu1.wav", plain);
    files_.add_sound("a.wav", plain);
    files_.add_sound("loop.wav", loop);
    files_.add_sound("ambience/water1.wav", loop);
    files_.add_sound("ambience/wind2.wav", loop);
    files_.add_sound("slow.wav", {.rate = 11025, .samples = std::vector<int>(11025, 16384)});
    files_.files["music/track02.wav"] = formats::testing::write_wav(plain);
    console_.execute("volume 1");
    sound_.start(44100, SoundOutput::kRecording, "test");
    scene_.right = vec3(0, -1, 0);
    scene_.entity = 1;
  }
  // Loudness left, of full scale halved twice, at the end of some time.
  float heard(double seconds = 0.02, bool focused = true) {
    sound_.update(scene_, focused);
    std::vector<float> stereo(2 * static_cast<std::size_t>(44100 * seconds));
    sound_.mix(stereo);
    return stereo[stereo.size() - 2] / 0.25f;
  }
  std::string log_of(const std::string& command) {
    ::testing::internal::CaptureStdout();
    console_.execute(command);
    return ::testing::internal::GetCapturedStdout();
  }
  void play(float volume = 1.0f, const vec3& origin = vec3(0.0f)) {
    sound_.hear(scene::SoundStart{"a.wav", 2, 1, origin, volume, 1.0f});
  }

  test::Files files_;
  con::Console console_;
  SoundSystem sound_{console_, files_.loader(), {}};
  scene::SoundScene scene_;
};

TEST_F(SystemTest, EventsAreHeardFromTheListener) {
  heard();
  play(0.5f, vec3(500, 0, 0));
  EXPECT_NEAR(heard(), 0.25f, 1e-5f);
  scene_.origin = vec3(500, 0, 0);
  EXPECT_NEAR(heard(), 0.5f, 1e-5f);
  sound_.hear(scene::SoundStop{2, 1});
  EXPECT_EQ(heard(), 0.0f);
}

TEST_F(SystemTest, ALevelEndsEverythingAndLoadsItsSounds) {
  play();
  sound_.hear(scene::SoundLoop{"loop.wav", vec3(0.0f), 0.5f, 1.0f});
  EXPECT_NEAR(heard(), 1.5f, 1e-5f);
  EXPECT_THAT(log_of("soundlist"), HasSubstr(" : a.wav"));
  sound_.hear(scene::SoundLevel{{"loop.wav", "slow.wav"}});
  EXPECT_EQ(heard(), 0.0f);
  const std::string list = log_of("soundlist");
  EXPECT_THAT(list, HasSubstr("L 16 bits  44100 Hz    1.00 s : loop.wav"));
  EXPECT_THAT(list, HasSubstr("  16 bits  11025 Hz    1.00 s : slow.wav"));
  EXPECT_THAT(list, ::testing::Not(HasSubstr(" : a.wav")));
}

TEST_F(SystemTest, WithoutPrecacheSoundsAreLoadedWhenPlayed) {
  console_.execute("precache 0");
  sound_.hear(scene::SoundLevel{{"a.wav"}});
  EXPECT_THAT(log_of("soundlist"), ::testing::Not(HasSubstr("a.wav")));
  play();
  EXPECT_THAT(log_of("soundlist"), HasSubstr("a.wav"));
}

TEST_F(SystemTest, WhatHasNoLoopIsToldOfOnceALevel) {
  ::testing::internal::CaptureStderr();
  for (int i = 0; i < 3; ++i) sound_.hear(scene::SoundLoop{"a.wav", vec3(0.0f), 1.0f, 1.0f});
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("sound/a.wav has no loop"));
  EXPECT_EQ(log.find("no loop"), log.rfind("no loop"));
  EXPECT_EQ(heard(), 0.0f);
}

TEST_F(SystemTest, AmbientLevelsOfTheLeaf) {
  scene_.ambient = {255, 10, 0, 0};
  EXPECT_NEAR(heard(2.0), 0.3f, 1e-4f) << "level 10 of 255 times 0.3 is too soft to be heard";
  console_.execute("ambient_level 0.5");
  EXPECT_NEAR(heard(2.0), 0.5f, 1e-4f);
  console_.execute("ambient_fade 51");
  scene_.ambient = {0, 0, 0, 0};
  EXPECT_NEAR(heard(1.0), 0.3f, 1e-3f) << "51 of 255 a second";
}

TEST_F(SystemTest, Cvars) {
  play();
  console_.execute("volume 0.25");
  EXPECT_NEAR(heard(), 0.25f, 1e-5f);
  EXPECT_EQ(heard(0.02, false), 0.0f) << "without focus it is silent";
  console_.execute("snd_mute_unfocused 0");
  EXPECT_NEAR(heard(0.02, false), 0.25f, 1e-5f);
  console_.execute("stopsound");
  EXPECT_EQ(heard(), 0.0f);
  console_.execute("nosound 1");
  play();
  EXPECT_EQ(heard(), 0.0f);
}

TEST_F(SystemTest, SettingsOfSamplesTakeEffectWithTheNext) {
  sound_.hear(scene::SoundStart{"slow.wav", 2, 1, vec3(0.0f), 1.0f, 0.0f});
  EXPECT_NEAR(heard(), 1.0f, 1e-3f);
  console_.execute("loadas8bit 1; sndspeed 44100; snd_filterquality 5");
  EXPECT_NEAR(heard(), 1.0f, 1e-3f) << "what plays plays on";
  EXPECT_THAT(log_of("soundlist"), ::testing::Not(HasSubstr("slow.wav")));
  sound_.hear(scene::SoundStart{"slow.wav", 2, 1, vec3(0.0f), 1.0f, 0.0f});
  EXPECT_THAT(log_of("soundlist"), HasSubstr("   8 bits  11025 Hz    1.00 s : slow.wav"));
}

TEST_F(SystemTest, CommandsPlay) {
  console_.execute("play a misc/menu1.wav");
  EXPECT_NEAR(heard(), 2.0f, 1e-5f) << "none ends the other";
  console_.execute("stopsound; playvol a 0.25 misc/menu1 0.5");
  EXPECT_NEAR(heard(), 0.75f, 1e-5f);
  console_.execute("stopsound");
  sound_.play_local("misc/menu1.wav");
  EXPECT_NEAR(heard(), 1.0f, 1e-5f);
  scene_.origin = vec3(9000, 0, 0);
  EXPECT_NEAR(heard(), 1.0f, 1e-5f) << "the program's own sounds come from nowhere";
  EXPECT_THAT(log_of("soundinfo"), HasSubstr("test: stereo, 44100 Hz"));
}

TEST_F(SystemTest, TracksAndTheCommandsOfMusic) {
  sound_.hear(scene::SoundTrack{2});
  EXPECT_NEAR(heard(), 1.0f, 1e-3f);
  EXPECT_THAT(log_of("music"), HasSubstr("music/track02.wav plays."));
  console_.execute("bgmvolume 0.5");
  EXPECT_NEAR(heard(), 0.5f, 1e-3f);
  console_.execute("volume 0");
  EXPECT_NEAR(heard(), 0.5f, 1e-3f) << "the music has its own volume";
  scene_.paused = true;
  EXPECT_EQ(heard(), 0.0f);
  scene_.paused = false;
  console_.execute("music_pause");
  EXPECT_EQ(heard(), 0.0f);
  console_.execute("cd resume");
  EXPECT_NEAR(heard(), 0.5f, 1e-3f);
  console_.execute("bgm_extmusic 0");
  EXPECT_EQ(heard(), 0.0f);
  console_.execute("bgm_extmusic 1");
  EXPECT_NEAR(heard(), 0.5f, 1e-3f) << "the level's track comes back";
  console_.execute("music_stop; music_loop off; music track02");
  EXPECT_NEAR(heard(0.9), 0.5f, 1e-3f);
  EXPECT_EQ(heard(0.3), 0.0f) << "played once";
  console_.execute("cd loop 2");
  EXPECT_NEAR(heard(2.5), 0.5f, 1e-3f);
  EXPECT_THAT(log_of("cd play x"), HasSubstr("cd play x: a whole number from 0 to 255 is wanted"));
  sound_.hear(scene::SoundLevel{});
  EXPECT_EQ(heard(), 0.0f) << "the game is left";
  sound_.forbid_music();
  sound_.hear(scene::SoundTrack{2});
  EXPECT_EQ(heard(), 0.0f);
}

TEST_F(SystemTest, SilentAndHarmlessUnlessStarted) {
  sound_.stop();
  play();
  sound_.play_local("misc/menu1.wav");
  EXPECT_EQ(heard(), 0.0f);
  EXPECT_THAT(log_of("play a"), HasSubstr("play: sound is off"));
  sound_.start(22050, SoundOutput::kRecording, "test");
  play();
  EXPECT_NEAR(heard(), 1.0f, 1e-5f) << "and can be started again, at another rate";
}

TEST_F(SystemTest, RecordingsRepeat) {
  const auto record = [&] {
    sound_.stop();
    sound_.start(44100, SoundOutput::kRecording, "test");
    sound_.hear(scene::SoundTrack{2});
    std::vector<float> all;
    for (int i = 0; i < 30; ++i) {
      scene_.origin = vec3(10.0f * static_cast<float>(i), 0, 0);
      if (i % 7 == 0) play(0.1f, vec3(100, 50, 0));
      sound_.update(scene_, true);
      std::vector<float> stereo(2 * 1470);
      sound_.mix(stereo);
      all.insert(all.end(), stereo.begin(), stereo.end());
    }
    return all;
  };
  EXPECT_EQ(record(), record());
}

// The device goes on while the game stands still for half a second: no mix is late, and what plays has no gap.
TEST(SoundThreads, ASlowFrameIsNotHeard) {
  test::Files files;
  files.add_sound("loop.wav", {.rate = 44100, .samples = std::vector<int>(4410, 16384), .cue = 0});
  files.files["music/track02.wav"] =
      formats::testing::write_wav({.rate = 44100, .samples = std::vector<int>(44100, 8192)});
  con::Console console;
  SoundSystem sound(console, files.loader(), {});
  console.execute("volume 1");
  sound.start(44100, SoundOutput::kDevice, "test");
  sound.hear(scene::SoundTrack{2});
  sound.hear(scene::SoundLoop{"loop.wav", vec3(0.0f), 1.0f, 1.0f});
  sound.update({}, true);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the music is decoded ahead
  std::atomic<bool> stop{false};
  std::vector<float> all;
  std::thread device([&] {
    auto due = std::chrono::steady_clock::now();
    while (!stop || all.size() / 2 < 44100u / 2) {
      std::vector<float> stereo(2 * 441);
      sound.mix(stereo);
      all.insert(all.end(), stereo.begin(), stereo.end());
      due += std::chrono::milliseconds(10);
      std::this_thread::sleep_until(due);
    }
  });
  for (int frame = 0; frame < 5; ++frame) {
    sound.update({}, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(frame == 2 ? 500 : 20));
  }
  stop = true;
  device.join();
  for (std::size_t i = 2 * 600; i < all.size(); ++i) ASSERT_NEAR(all[i], 0.25f + 0.125f, 1e-3f) << i;
  EXPECT_EQ(sound.figures().music_late, 0u);
}

// The game says all it can as fast as it can, begins levels and drops samples, while the device mixes: for sanitizers.
TEST(SoundThreads, Stress) {
  test::Files files;
  for (int i = 0; i < 10; ++i)
    files.add_sound(fmt::format("{}.wav", i), {.samples = std::vector<int>(2000, 1000 * i), .cue = 10});
  files.files["music/track02.wav"] = formats::testing::write_wav({.samples = std::vector<int>(5000, 1)});
  con::Console console;
  SoundSystem sound(console, files.loader(), {});
  sound.start(44100, SoundOutput::kDevice, "test");
  std::atomic<bool> stop{false};
  std::thread device([&] {
    std::vector<float> stereo(2 * 256);
    while (!stop) sound.mix(stereo);
  });
  std::vector<std::string> names;
  for (int i = 0; i < 5; ++i) names.push_back(fmt::format("{}.wav", i));
  for (int frame = 0; frame < 400; ++frame) {
    if (frame % 40 == 0) sound.hear(scene::SoundLevel{names});
    if (frame % 50 == 0) sound.hear(scene::SoundTrack{2});
    if (frame % 60 == 0) console.execute(fmt::format("snd_filterquality {}", 1 + frame / 60 % 5));
    for (int i = 0; i < 10; ++i) {
      sound.hear(scene::SoundStart{fmt::format("{}.wav", i), frame % 20, i % 4, vec3(0.0f), 0.1f, 1.0f});
      if (frame % 20 == 3) sound.hear(scene::SoundLoop{fmt::format("{}.wav", i), vec3(0.0f), 0.1f, 1.0f});
    }
    sound.update({}, true);
  }
  stop = true;
  device.join();
  sound.stop();
  EXPECT_GT(sound.figures().frames, 0u);
}

// A device that stands still loses no level's end and no loop, and the queue of what waits stays short.
TEST_F(SystemTest, ADeviceThatStandsStill) {
  sound_.update(scene_, true);
  for (int i = 0; i < 3000; ++i) {
    play(0.01f);
    sound_.update(scene_, true);
  }
  sound_.hear(scene::SoundLoop{"loop.wav", vec3(0.0f), 0.25f, 1.0f});
  sound_.hear(scene::SoundLevel{{"loop.wav"}});
  sound_.hear(scene::SoundLoop{"loop.wav", vec3(0.0f), 0.5f, 1.0f});
  heard();
  EXPECT_NEAR(heard(), 0.5f, 1e-5f);
}

}  // namespace
}  // namespace fb::audio
