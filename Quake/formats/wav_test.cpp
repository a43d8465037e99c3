// Wave files: widths, channels, loops, and files that are damaged.
#include "formats/wav.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/invariants.h"
#include "formats/test_corruption.h"
#include "formats/test_waves.h"

namespace fb::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::WaveFile;
using testing::write_wav;

const testing::Attempt kWaveAttempt =
    testing::attempt([](const Bytes& bytes) { return parse_wav(bytes, "sound/x.wav"); },
                     [](const Wav& wav) { return testing::broken(wav); });

Wav parsed(const WaveFile& wave) {
  const auto wav = parse_wav(write_wav(wave), "sound/x.wav");
  EXPECT_TRUE(wav.ok()) << (wav.ok() ? "" : wav.error().message);
  return wav.ok() ? *wav : Wav{};
}
std::string refusal(const WaveFile& wave) {
  const auto wav = parse_wav(write_wav(wave), "sound/x.wav");
  return wav.ok() ? "taken" : wav.error().message;
}

TEST(Waves, SixteenBits) {
  const Wav wav = parsed({.rate = 22050});
  EXPECT_EQ(wav.rate, 22050u);
  EXPECT_EQ(wav.bits, 16);
  EXPECT_THAT(wav.samples, ElementsAre(0, 1000, -1000, 32767, -32768, 5));
  EXPECT_FALSE(wav.loop_start);
  EXPECT_EQ(wav.flaw, "");
}

TEST(Waves, EightBitsAreTheUpperOnes) {
  const Wav wav = parsed({.bits = 8, .samples = {0, 256, -256, 127 * 256, -32768}});
  EXPECT_EQ(wav.bits, 8);
  EXPECT_THAT(wav.samples, ElementsAre(0, 256, -256, 32512, -32768));
}

TEST(Waves, TwoChannelsAreAveraged) {
  const Wav wav = parsed({.channels = 2, .samples = {100, 300, -100, -300, 32767, 32767}});
  EXPECT_EQ(wav.channels, 2);
  EXPECT_THAT(wav.samples, ElementsAre(200, -200, 32767));
}

TEST(Waves, LoopsByCueAndMark) {
  EXPECT_EQ(parsed({.cue = 2}).loop_start, 2u);
  EXPECT_EQ(parsed({.cue = 2}).samples.size(), 6u);
  const Wav marked = parsed({.cue = 2, .marked = 3});
  EXPECT_EQ(marked.loop_start, 2u);
  EXPECT_EQ(marked.samples.size(), 5u) << "the loop's length ends the sound";
  EXPECT_EQ(parsed({.cue = 0, .marked = 6, .odd_chunk = true}).loop_start, 0u) << "chunks are padded to even sizes";
  EXPECT_FALSE(parsed({.marked = 3}).loop_start) << "a mark without a cue is no loop";
  EXPECT_EQ(parsed({.cue = 1, .marked = 0}).samples.size(), 6u);
}

TEST(Waves, LoopsThatCannotBe) {
  const Wav late = parsed({.cue = 6});
  EXPECT_FALSE(late.loop_start);
  EXPECT_THAT(late.flaw, HasSubstr("begins at sample 6 of 6"));
  const Wav wide = parsed({.cue = 2, .marked = 5});
  EXPECT_EQ(wide.loop_start, 2u);
  EXPECT_EQ(wide.samples.size(), 6u);
  EXPECT_THAT(wide.flaw, HasSubstr("ends behind the last"));
  EXPECT_THAT(parsed({.cue = 2, .marked = 0xffffffffu}).flaw, HasSubstr("ends behind the last"));
}

TEST(Waves, RefusesWhatItCannotPlay) {
  EXPECT_THAT(refusal({.bits = 24}), HasSubstr("24 bits"));
  EXPECT_THAT(refusal({.format = 2}), HasSubstr("format 2"));
  EXPECT_THAT(refusal({.channels = 6}), HasSubstr("6 channels"));
  EXPECT_THAT(refusal({.channels = 0}), HasSubstr("0 channels"));
  EXPECT_THAT(refusal({.rate = 999}), HasSubstr("999 samples a second"));
  EXPECT_THAT(refusal({.rate = 384001}), HasSubstr("384001 samples a second"));
  EXPECT_THAT(refusal({.samples = {}}), HasSubstr("no sample"));
  EXPECT_EQ(refusal({.format = 2}), "sound/x.wav: offset 20: format 2; only uncompressed PCM (1) is played");
}

TEST(Waves, ExtensibleFormatNamesPcmInItsSubformat) {
  testing::ByteWriter format, file;
  for (const std::uint32_t word : {0xfffeu, 1u, 11025u & 0xffffu, 0u, 22050u, 0u, 2u, 16u, 22u, 16u, 4u, 0u, 1u})
    format.u16(word);
  format.text("", 14);
  file.text("RIFFxxxxWAVE", 12);
  testing::write_chunk(file, "fmt ", format.out);
  testing::write_chunk(file, "data", Bytes{1, 0, 2, 0});
  EXPECT_EQ(kWaveAttempt(file.out).text, "");
  file.patch_u32(12 + 8 + 24, 3);
  EXPECT_THAT(kWaveAttempt(file.out).text, HasSubstr("format 3"));
}

// Samples begin at 44: what there is of them is played.
TEST(Waves, WhenCutWhatIsThereIsPlayed) {
  const Bytes whole = write_wav({});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    if (length < 46) {
      testing::expect_refused(kWaveAttempt, cut, "sound/x.wav");
      continue;
    }
    const auto wav = parse_wav(cut, "sound/x.wav");
    ASSERT_TRUE(wav.ok()) << length << ": " << wav.error().message;
    EXPECT_EQ(wav->samples.size(), (length - 44) / 2);
    EXPECT_EQ(wav->flaw, "sound/x.wav: the data chunk wants " + std::to_string(whole.size() - length) +
                             " bytes more than the file has; it ends there");
  }
}
// Writers that stream do not know the length: they say the greatest, or one of their own.
TEST(Waves, DataOfUnknownLength) {
  for (const std::uint32_t said : {0xffffffffu, 0x7ffff000u}) {
    testing::ByteWriter file{write_wav({})};
    file.patch_u32(40, said);
    const auto wav = parse_wav(file.out, "sound/x.wav");
    ASSERT_TRUE(wav.ok()) << wav.error().message;
    EXPECT_THAT(wav->samples, ElementsAre(0, 1000, -1000, 32767, -32768, 5));
  }
}
// A list or a cue that was cut: the sound itself is whole.
TEST(Waves, AChunkBehindTheSamplesThatIsCut) {
  Bytes file = write_wav({.cue = 2, .marked = 3});
  file.resize(file.size() - 4);
  const auto wav = parse_wav(file, "sound/x.wav");
  ASSERT_TRUE(wav.ok()) << wav.error().message;
  EXPECT_EQ(wav->samples.size(), 6u);
  EXPECT_EQ(wav->loop_start, 2u);
  EXPECT_EQ(wav->flaw, "");
}

TEST(Waves, SoundWhenDamaged) {
  for (const std::uint32_t bits : {8u, 16u}) {
    testing::expect_sound_when_damaged(
        kWaveAttempt, write_wav({.channels = 2, .bits = bits, .cue = 1, .marked = 2, .odd_chunk = true}),
        "sound/x.wav");
  }
}

}  // namespace
}  // namespace fb::formats
