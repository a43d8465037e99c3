// Music: every format is decoded, streams loop and change rates without a seam, and damaged files end with a sentence.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <ostream>
#include <thread>

#include "audio/mixer.h"
#include "audio/music_decoder.h"
#include "audio/music_player.h"
#include "audio/music_stream.h"
#include "audio/ogg_flac.h"
#include "audio/test_sounds.h"
#include "base/rng.h"
#include "base/test_directory.h"

namespace fb::audio {
namespace {

using ::testing::HasSubstr;

constexpr double kTone = 440.0;

// One second of a tone at half of full scale, in a file of this format; the right side is quieter.
Bytes music_file(int format, int rate, int channels = 2) {
  const TestDirectory directory;
  const std::string path = (directory.path() / "music").string();
  SF_INFO info = {};
  info.samplerate = rate;
  info.channels = channels;
  info.format = format;
  SNDFILE* const file = sf_open(path.c_str(), SFM_WRITE, &info);
  EXPECT_TRUE(file) << sf_strerror(nullptr);
  if (!file) return {};
  const std::vector<float> tone = test::sine(kTone, rate, static_cast<std::size_t>(rate));
  std::vector<float> frames;
  for (const float value : tone)
    for (int c = 0; c < channels; ++c) frames.push_back(c == 0 ? 0.5f * value : 0.25f * value);
  sf_writef_float(file, frames.data(), rate);
  sf_close(file);
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A module of one pattern: its one sample is a tone that loops, played from the first row on.
Bytes module_file() {
  formats::testing::ByteWriter w;
  w.text("tone", 20);
  const auto sample = [&](std::uint32_t words) {
    w.text("", 22);
    for (const std::uint32_t value : {words >> 8u, words & 0xffu, 0u, 64u, 0u, 0u, words >> 8u, words & 0xffu})
      w.u8(value);
  };
  sample(16);
  for (int i = 1; i < 31; ++i) sample(i == 1 ? 0 : 0);
  w.u8(1);
  w.u8(127);
  w.text("", 128);
  w.text("M.K.", 4);
  for (std::uint32_t row = 0; row < 64; ++row)
    for (std::uint32_t channel = 0; channel < 4; ++channel)
      for (const std::uint32_t value :
           {row + channel == 0 ? 1u : 0u, row + channel == 0 ? 0xacu : 0u, row + channel == 0 ? 0x10u : 0u, 0u})
        w.u8(value);
  for (int i = 0; i < 32; ++i) w.u8(i < 16 ? 100u : 156u);
  return w.out;
}

struct Format {
  const char* extension;
  int format, rate;
};
void PrintTo(const Format& format, std::ostream* out) { *out << format.extension; }

class MusicFormats : public ::testing::TestWithParam<Format> {};

TEST_P(MusicFormats, AreDecodedInStereo) {
  const auto [extension, format, rate] = GetParam();
  const std::string name = fmt::format("music/track02.{}", extension);
  auto decoder = open_music(music_file(format, rate), name, 44100);
  ASSERT_TRUE(decoder.ok()) << decoder.error().message;
  EXPECT_EQ((*decoder)->rate(), static_cast<std::uint32_t>(rate));
  std::vector<float> frames(2 * static_cast<std::size_t>(rate));
  for (int round = 0; round < 2; ++round) {
    std::size_t read = 0;
    while (const std::size_t some = (*decoder)->read(std::span(frames).subspan(2 * read))) read += some;
    ASSERT_GT(read, frames.size() / 2 * 9 / 10);
    std::vector<float> left, right;
    for (std::size_t i = 0; i < read; ++i) {
      left.push_back(frames[2 * i]);
      right.push_back(frames[2 * i + 1]);
    }
    EXPECT_NEAR(test::rms(left, read / 4, read / 2), 0.5 * std::sqrt(0.5), 0.02);
    EXPECT_NEAR(test::rms(right, read / 4, read / 2), 0.25 * std::sqrt(0.5), 0.02);
    ASSERT_TRUE((*decoder)->rewind());
  }
}
INSTANTIATE_TEST_SUITE_P(All, MusicFormats,
                         ::testing::Values(Format{"ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 44100},
                                           Format{"opus", SF_FORMAT_OGG | SF_FORMAT_OPUS, 48000},
                                           Format{"mp3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III, 44100},
                                           Format{"flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 48000},
                                           Format{"wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 22050}));

// What a file is its bytes say: players rename them.
TEST_P(MusicFormats, AreKnownByWhatTheyHold) {
  const auto [extension, format, rate] = GetParam();
  const Bytes file = music_file(format, rate);
  for (const char* wrong : {"ogg", "opus", "mp3", "flac", "wav", "it", "mod"}) {
    auto decoder = open_music(file, fmt::format("music/track02.{}", wrong), 44100);
    ASSERT_TRUE(decoder.ok()) << wrong << ": " << decoder.error().message;
    EXPECT_EQ((*decoder)->rate(), static_cast<std::uint32_t>(rate));
  }
}
TEST(Music, ModulesAreKnownByWhatTheyHold) {
  for (const char* wrong : {"ogg", "wav", "xm"}) {
    auto decoder = open_music(module_file(), fmt::format("music/a.{}", wrong), 48000);
    ASSERT_TRUE(decoder.ok()) << wrong << ": " << decoder.error().message;
    EXPECT_EQ((*decoder)->rate(), 48000u);
  }
}

// A file of FLAC in pages of Ogg, with another stream's page between them.
Bytes in_ogg(const Bytes& flac, std::size_t page_size = 5000) {
  formats::testing::ByteWriter w;
  std::uint32_t number = 0;
  const auto page = [&](ByteView payload, std::uint32_t serial) {
    w.text("OggS", 4);
    w.u8(0);
    w.u8(number == 0 ? 2 : 0);
    w.u32(0);
    w.u32(0);
    w.u32(serial);
    w.u32(number++);
    w.u32(0);  // the checksum, which nobody asks for
    const std::size_t segments = payload.size() / 255 + 1;
    w.u8(static_cast<std::uint32_t>(segments));
    for (std::size_t i = 0; i + 1 < segments; ++i) w.u8(255);
    w.u8(static_cast<std::uint32_t>(payload.size() % 255));
    w.bytes(payload);
  };
  formats::testing::ByteWriter first;
  first.text(
      "\x7f"
      "FLAC",
      5);
  for (const std::uint32_t byte : {1u, 0u, 0u, 1u}) first.u8(byte);
  constexpr std::size_t kInfo = 4 + 4 + 34;  // the mark and STREAMINFO
  first.bytes(ByteView(flac).first(kInfo));
  page(first.out, 7);
  page(Bytes(100, 3), 8);
  for (std::size_t at = kInfo; at < flac.size(); at += page_size)
    page(ByteView(flac).subspan(at, std::min(page_size, flac.size() - at)), 7);
  return w.out;
}

TEST(Music, FlacWithinOggIsTakenOut) {
  const Bytes flac = music_file(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 44100);
  const Bytes ogg = in_ogg(flac);
  EXPECT_EQ(flac_of_ogg(ogg), flac);
  auto decoder = open_music(ogg, "music/track03.ogg", 44100);
  ASSERT_TRUE(decoder.ok()) << decoder.error().message;
  std::vector<float> frames(2 * 44100), left;
  ASSERT_EQ((*decoder)->read(frames), 44100u);
  for (std::size_t i = 0; i < 44100; ++i) left.push_back(frames[2 * i]);
  EXPECT_NEAR(test::rms(left, 10000, 20000), 0.5 * std::sqrt(0.5), 0.02);
  EXPECT_TRUE((*decoder)->rewind());

  EXPECT_EQ(flac_of_ogg(flac), std::nullopt);
  EXPECT_EQ(flac_of_ogg(music_file(SF_FORMAT_OGG | SF_FORMAT_VORBIS, 44100)), std::nullopt);
  for (std::size_t length = 0; length < ogg.size(); length += 97) {
    const Bytes cut(ogg.begin(), ogg.begin() + static_cast<std::ptrdiff_t>(length));
    const auto out = flac_of_ogg(cut);
    EXPECT_TRUE(!out || std::equal(out->begin(), out->end(), flac.begin())) << length;
    if (auto music = open_music(cut, "music/a.ogg", 44100); music.ok()) (*music)->read(frames);
  }
}

TEST(Music, OneChannelIsHeardOnBothSides) {
  auto decoder = open_music(music_file(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1), "music/a.wav", 44100);
  ASSERT_TRUE(decoder.ok()) << decoder.error().message;
  std::vector<float> frames(200);
  ASSERT_EQ((*decoder)->read(frames), 100u);
  EXPECT_NE(frames[20], 0.0f);
  EXPECT_EQ(frames[20], frames[21]);
}

TEST(Music, ModulesArePlayedAtTheMixingRate) {
  auto decoder = open_music(module_file(), "music/a.mod", 48000);
  ASSERT_TRUE(decoder.ok()) << decoder.error().message;
  EXPECT_EQ((*decoder)->rate(), 48000u);
  std::vector<float> frames(2 * 48000);
  ASSERT_EQ((*decoder)->read(frames), 48000u);
  EXPECT_GT(test::rms(frames, 10000, 90000), 0.01);
  EXPECT_TRUE((*decoder)->rewind());
}

TEST(Music, DamagedFilesNameThemselvesAndTheCause) {
  const Bytes noise(500, 77);
  EXPECT_THAT(open_music(noise, "music/a.ogg", 44100).error().message, HasSubstr("music/a.ogg: "));
  EXPECT_THAT(open_music(noise, "music/a.xm", 44100).error().message, HasSubstr("music/a.xm: "));
  EXPECT_FALSE(open_music(Bytes{}, "music/a.flac", 44100).ok());
  // Cut and overwritten anywhere, a file may be refused or end early; it must not do worse.
  Rng rng(3);
  for (const int format : {SF_FORMAT_OGG | SF_FORMAT_VORBIS, SF_FORMAT_FLAC | SF_FORMAT_PCM_16,
                           SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III}) {
    const Bytes whole = music_file(format, 44100);
    for (int trial = 0; trial < 20; ++trial) {
      Bytes bad(whole.begin(),
                whole.begin() + static_cast<std::ptrdiff_t>(rng.below(static_cast<std::uint32_t>(whole.size()))));
      for (int i = 0; i < 8 && !bad.empty(); ++i)
        bad[rng.below(static_cast<std::uint32_t>(bad.size()))] = static_cast<std::uint8_t>(rng.next());
      auto decoder = open_music(bad, "music/a.x", 44100);
      if (!decoder.ok()) continue;
      std::vector<float> frames(8192);
      for (int i = 0; i < 100 && (*decoder)->read(frames) > 0; ++i) {}
    }
  }
}

std::unique_ptr<MusicStream> stream_of(int rate, std::uint32_t mix_rate, bool threaded) {
  auto decoder = open_music(music_file(SF_FORMAT_WAV | SF_FORMAT_PCM_16, rate), "music/a.wav", mix_rate);
  return std::make_unique<MusicStream>(std::move(*decoder), "music/a.wav", mix_rate, 1, threaded);
}

// 440 periods in a second: the end goes on into the beginning.
void expect_tone_without_seam(const std::vector<float>& stereo, double mix_rate) {
  const std::vector<float> ideal = test::sine(kTone, mix_rate, stereo.size() / 2);
  for (std::size_t i = 100; i < ideal.size(); ++i) ASSERT_NEAR(stereo[2 * i], 0.5f * ideal[i], 2e-3f) << i;
}

TEST(MusicStream, LoopsWithoutASeamAtEveryRate) {
  for (const int rate : {22050, 44100, 48000}) {
    const auto stream = stream_of(rate, 44100, false);
    std::vector<float> stereo(2 * 44100 * 3);
    for (std::size_t at = 0; at < stereo.size(); at += 1764)
      ASSERT_EQ(stream->read(std::span(stereo).subspan(at, 1764)), 882u);
    expect_tone_without_seam(stereo, 44100);
  }
}

TEST(MusicStream, EndsIfItDoesNotLoop) {
  const auto stream = stream_of(48000, 44100, false);
  stream->set_looping(false);
  std::vector<float> stereo(2 * 50000);
  EXPECT_EQ(stream->read(stereo), 44100u);
  EXPECT_TRUE(stream->finished());
  EXPECT_EQ(stream->read(stereo), 0u);
}

TEST(MusicStream, PausesWhereItIs) {
  const auto stream = stream_of(44100, 44100, false);
  std::vector<float> stereo(2 * 2000);
  ASSERT_EQ(stream->read(std::span(stereo).first(2000)), 1000u);
  stream->set_paused(true);
  EXPECT_EQ(stream->read(std::span(stereo).subspan(2000)), 0u);
  stream->set_paused(false);
  ASSERT_EQ(stream->read(std::span(stereo).subspan(2000)), 1000u);
  expect_tone_without_seam(stereo, 44100);
}

TEST(MusicStream, IsDecodedAheadOnItsThread) {
  const auto stream = stream_of(48000, 44100, true);
  std::vector<float> stereo;
  for (int waited = 0; stereo.size() < 2 * 44100 && waited < 2000; ++waited) {
    std::vector<float> block(2 * 441);
    const std::size_t read = stream->read(block);
    stereo.insert(stereo.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(2 * read));
    std::this_thread::sleep_for(std::chrono::milliseconds(read == 0 ? 5 : 0));
  }
  ASSERT_GE(stereo.size(), 2u * 44100);
  expect_tone_without_seam(stereo, 44100);
}

// The mixer's: a tone moves by at most amplitude * 2 pi * 440 / rate a frame, what is cut by its value over the frames
// of kStepFade. It is paused and ends where it is largest, 25 of its 100.2 frames after a zero.
TEST(MusicStream, PausesAndEndsWithoutAStep) {
  constexpr std::uint32_t kRate = 44100;
  constexpr double kAmplitude = 0.5 * 0.5;
  const double most = kAmplitude * (2.0 * std::numbers::pi * kTone / kRate + 1.0 / (kStepFade * kRate)) + 1e-3;
  ASSERT_LT(most, 0.3 * kAmplitude) << "or no step would be seen";
  Mixer mixer(kRate);
  const std::shared_ptr<MusicStream> stream = stream_of(kRate, kRate, false);
  mixer.apply(command::Music{stream});
  float before = 0.0f, largest = 0.0f;
  const auto mix = [&](std::size_t frames) {
    std::vector<float> stereo(2 * frames);
    mixer.mix(stereo);
    for (std::size_t i = 0; i < frames; ++i) {
      largest = std::max(largest, std::abs(stereo[2 * i] - before));
      before = stereo[2 * i];
    }
    return std::abs(before);
  };
  EXPECT_GT(mix(26), 0.9 * kAmplitude);
  stream->set_paused(true);
  EXPECT_EQ(mix(300), 0.0f);
  stream->set_paused(false);
  mix(300);
  EXPECT_LT(largest, most) << "paused, and going on";
  mix(75);  // 401 frames after the beginning: a zero and a frame
  EXPECT_GT(mix(25), 0.9 * kAmplitude);
  mixer.apply(command::Music{stream_of(kRate, kRate, false)});
  EXPECT_GT(mix(326), 0.9 * kAmplitude);
  mixer.apply(command::Music{nullptr});
  EXPECT_EQ(mix(300), 0.0f);
  EXPECT_LT(largest, most) << "another piece, and the end";
}

class PlayerTest : public ::testing::Test {
 protected:
  MusicPlayer player(FileRank rank = {}) {
    return MusicPlayer(files_.loader(), std::move(rank),
                       [this](std::shared_ptr<MusicStream> s) { sent_ = std::move(s); });
  }
  Bytes tone_ = music_file(SF_FORMAT_WAV | SF_FORMAT_PCM_16, 22050);
  test::Files files_;
  std::shared_ptr<MusicStream> sent_;
};

TEST_F(PlayerTest, TracksAreFilesOfTheirNumber) {
  files_.files["music/track02.wav"] = tone_;
  MusicPlayer p = player();
  p.set_output(44100, 1, false);
  p.play_track(2);
  EXPECT_EQ(p.playing(), "music/track02.wav");
  ASSERT_TRUE(sent_);
  p.play_track(3);
  EXPECT_EQ(p.playing(), "") << "a missing track is silence";
  EXPECT_FALSE(sent_);
  p.play_track(2);
  p.play_track(0);
  EXPECT_FALSE(sent_);
}

TEST_F(PlayerTest, TheLastGameDirectoryCountsBeforeTheFormat) {
  files_.files["music/track02.flac"] = files_.files["music/track02.wav"] = tone_;
  MusicPlayer p = player([](std::string_view path) { return path.ends_with(".wav") ? 1 : 0; });
  p.set_output(44100, 1, false);
  p.play_track(2);
  EXPECT_EQ(p.playing(), "music/track02.wav");
  MusicPlayer equal = player();
  equal.set_output(44100, 1, false);
  equal.play_track(2);
  EXPECT_EQ(equal.playing(), "music/track02.flac");
}

TEST_F(PlayerTest, NamesWithAndWithoutExtension) {
  files_.files["music/theme.wav"] = tone_;
  files_.files["music/bad.ogg"] = Bytes(100, 3);
  MusicPlayer p = player();
  EXPECT_FALSE(p.play("theme")) << "there is no output yet";
  p.set_output(44100, 1, false);
  EXPECT_TRUE(p.play("theme"));
  EXPECT_TRUE(p.play("theme.wav"));
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(p.play("nothing"));
  EXPECT_FALSE(p.play("bad"));
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("music/nothing is missing"));
  EXPECT_THAT(log, HasSubstr("music/bad.ogg: "));
  EXPECT_FALSE(sent_) << "what played before has ended";
}

TEST_F(PlayerTest, IsPausedByTheGameOrByThePlayer) {
  files_.files["music/theme.wav"] = tone_;
  MusicPlayer p = player();
  p.set_output(44100, 1, false);
  ASSERT_TRUE(p.play("theme"));
  p.pause_by_game(true);
  EXPECT_TRUE(sent_->paused());
  p.pause_by_player(true);
  p.pause_by_game(false);
  EXPECT_TRUE(sent_->paused());
  p.pause_by_player(false);
  EXPECT_FALSE(sent_->paused());
}

}  // namespace
}  // namespace fb::audio
