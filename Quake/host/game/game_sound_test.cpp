// The sound of the program with SDL's dummy driver: it goes on through a slow frame; a recording is in step with time.
#include "host/game/game_sound.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/test_directory.h"
#include "formats/test_waves.h"
#include "formats/wav.h"

namespace fb::host {
namespace {

class GameSoundTest : public ::testing::Test {
 protected:
  GameSoundTest() {
    ::setenv("SDL_AUDIODRIVER", "dummy", 1);
    directory_.put("id1/sound/a.wav",
                   formats::testing::write_wav({.rate = 44100, .samples = std::vector<int>(44100, 16384), .cue = 0}));
    auto engine = Engine::create({"-basedir", directory_.path().string(), "-nohome"}, {.server = false});
    EXPECT_TRUE(engine.ok()) << (engine.ok() ? "" : engine.error().message);
    engine_ = std::move(*engine);
  }
  TestDirectory directory_;
  std::unique_ptr<Engine> engine_;
};

TEST_F(GameSoundTest, ASlowFrameDelaysNoMix) {
  GameSound sound(*engine_);
  ASSERT_TRUE(sound.open({}).ok());
  ASSERT_TRUE(engine_->sound().started());
  engine_->console().execute("play a");
  sound.update(true);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto before = engine_->sound().figures();
  // A slow frame, half a second long or, on a busy machine, as long as it takes: only the device's thread runs.
  const auto fed = [&] { return engine_->sound().figures().frames - before.frames; };
  for (int i = 0; i < 1000 && fed() <= 44100u / 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto after = engine_->sound().figures();
  EXPECT_GT(fed(), 44100u / 2) << "the device was fed while the game stood still";
  RecordProperty("late", std::to_string(after.late));
  RecordProperty("longest_wait", std::to_string(after.longest_wait));
}

TEST_F(GameSoundTest, SaysOnceThatThereIsNoDevice) {
  ::setenv("SDL_AUDIODRIVER", "no such driver", 1);
  GameSound sound(*engine_);
  ::testing::internal::CaptureStderr();
  EXPECT_TRUE(sound.open({}).ok());
  sound.update(true);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), ::testing::HasSubstr("; the game is silent"));
  EXPECT_FALSE(engine_->sound().started());
}

TEST_F(GameSoundTest, IsSilentWhereItIsNotWanted) {
  GameOptions headless, off;
  headless.headless = true;
  off.sound = false;
  for (const GameOptions& options : {headless, off}) {
    GameSound sound(*engine_);
    EXPECT_TRUE(sound.open(options).ok());
    EXPECT_FALSE(engine_->sound().started());
  }
  headless.sound_asked = true;
  GameSound sound(*engine_);
  EXPECT_TRUE(sound.open(headless).ok());
  EXPECT_TRUE(engine_->sound().started());
}

TEST_F(GameSoundTest, RecordsAsMuchAsTimePasses) {
  GameOptions options;
  options.headless = true;
  options.wav_capture = directory_.file("mix.wav");
  options.mix_speed = 22050;
  {
    GameSound sound(*engine_);
    ASSERT_TRUE(sound.open(options).ok());
    engine_->console().execute("volume 1");
    for (int frame = 0; frame < 60; ++frame) {
      if (frame == 30) engine_->console().execute("play a");
      engine_->client().advance(1.0 / 60.0);
      sound.update(true);
      ASSERT_TRUE(sound.record().ok());
    }
    ASSERT_TRUE(sound.finish().ok());
  }
  std::ifstream in(options.wav_capture, std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(in), {}};
  const auto wav = formats::parse_wav(bytes, "mix.wav");
  ASSERT_TRUE(wav.ok()) << wav.error().message;
  ASSERT_EQ(wav->samples.size(), 22050u);
  EXPECT_EQ(wav->samples[11020], 0);
  EXPECT_GT(wav->samples[11025 + 50], 1000) << "begins with its frame";
  EXPECT_NEAR(wav->samples[11025 + 200], 8192, 300) << "a loop, which may begin anywhere, rises within 5 ms";
}

TEST_F(GameSoundTest, NamesAFileThatCannotBeRecordedInto) {
  GameOptions options;
  options.wav_capture = directory_.file("no folder/mix.wav");
  GameSound sound(*engine_);
  const Status status = sound.open(options);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, ::testing::StartsWith("-wavcapture "));
}

}  // namespace
}  // namespace fb::host
