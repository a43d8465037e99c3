// Samples: made of files, loaded once, and freed only when nobody plays them any more.
#include "audio/sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audio/test_sounds.h"

namespace fb::audio {
namespace {

using formats::testing::WaveFile;

TEST(Samples, AreMadeAtTheMixingRate) {
  test::Files files;
  files.add_sound("a.wav", {.rate = 11025, .samples = std::vector<int>(100, 12345), .cue = 25});
  SampleCache cache(files.loader());
  const SamplePtr a = cache.load("a.wav");
  ASSERT_TRUE(a);
  EXPECT_EQ(a->name, "a.wav");
  EXPECT_EQ(a->frames.size(), 400u);
  EXPECT_EQ(a->loop_start, 100u);
  EXPECT_EQ(a->frames[200], 12345);
  EXPECT_EQ(cache.load("a.wav"), a) << "loaded once";
}

TEST(Samples, EightBits) {
  test::Files files;
  files.add_sound("a.wav", {.rate = 44100, .samples = {1000, -1000, 32767, -32768}});
  SampleCache cache(files.loader());
  cache.set_format({44100, 1, false, true});
  const SamplePtr a = cache.load("a.wav");
  EXPECT_THAT(a->frames, ::testing::ElementsAre(1024, -1024, 32512, -32768));
  EXPECT_EQ(a->bits, 8);
}

TEST(Samples, MissingAndMalformedAreToldOnce) {
  test::Files files;
  files.files["sound/bad.wav"] = Bytes{1, 2, 3};
  SampleCache cache(files.loader());
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(cache.load("no.wav"));
  EXPECT_FALSE(cache.load("no.wav"));
  EXPECT_FALSE(cache.load("bad.wav"));
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, ::testing::HasSubstr("sound/no.wav is missing"));
  EXPECT_EQ(log.find("no.wav"), log.rfind("no.wav"));
  EXPECT_THAT(log, ::testing::HasSubstr("sound/bad.wav: offset 0: not a RIFF/WAVE file"));
}

TEST(Samples, TooLongToBeKept) {
  formats::Wav wav;
  wav.rate = 1000;
  wav.samples.assign(400000, 1);
  const auto sample = make_sample(wav, "long.wav", {192000, 1, true, false});
  ASSERT_FALSE(sample.ok());
  EXPECT_EQ(sample.error().message, "sound/long.wav: 400 seconds are too long for a sound");
}

// Small files of a low rate ask for much.
TEST(Samples, BeyondTheirRoomAreNotLoadedAndToldOnce) {
  test::Files files;
  for (const char* name : {"a.wav", "b.wav", "c.wav", "d.wav"})
    files.add_sound(name, {.rate = 1000, .samples = std::vector<int>(100, 1)});  // 8,820 bytes each, at 44.1 kHz
  files.add_sound("small.wav", {.rate = 44100, .samples = std::vector<int>(100, 1)});
  SampleCache cache(files.loader(), 20000);
  ::testing::internal::CaptureStderr();
  EXPECT_TRUE(cache.load("a.wav"));
  EXPECT_TRUE(cache.load("b.wav"));
  EXPECT_FALSE(cache.load("c.wav"));
  EXPECT_FALSE(cache.load("d.wav"));
  EXPECT_FALSE(cache.load("c.wav"));
  EXPECT_TRUE(cache.load("small.wav"));
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, ::testing::HasSubstr("sound/c.wav: not loaded, nor any other sound for which there is no room"));
  EXPECT_EQ(log.find("not loaded"), log.rfind("not loaded"));
  cache.keep_only({"a.wav", "c.wav"});  // another level
  EXPECT_TRUE(cache.load("c.wav"));
  EXPECT_FALSE(cache.load("d.wav"));
}

TEST(Samples, LiveUntilNobodyPlaysThem) {
  test::Files files;
  for (const char* name : {"a.wav", "b.wav", "c.wav"}) files.add_sound(name, WaveFile{});
  SampleCache cache(files.loader());
  const std::weak_ptr<const Sample> a = cache.load("a.wav"), c = cache.load("c.wav");
  SamplePtr b = cache.load("b.wav");
  cache.keep_only({"c.wav"});
  EXPECT_EQ(cache.loaded().size(), 1u);
  EXPECT_EQ(cache.waiting(), 2u);
  EXPECT_FALSE(a.expired()) << "only collect() frees";
  cache.collect();
  EXPECT_TRUE(a.expired());
  EXPECT_EQ(cache.waiting(), 1u) << "b is played";
  b.reset();
  cache.collect();
  EXPECT_EQ(cache.waiting(), 0u);
  EXPECT_FALSE(c.expired());
}

TEST(Samples, AnotherFormatLoadsThemAnew) {
  test::Files files;
  files.add_sound("a.wav", {.rate = 11025});
  SampleCache cache(files.loader());
  const SamplePtr before = cache.load("a.wav");
  cache.set_format({44100, 1, false, false});
  EXPECT_EQ(cache.load("a.wav"), before) << "the same format changes nothing";
  cache.set_format({22050, 1, false, false});
  const SamplePtr after = cache.load("a.wav");
  EXPECT_EQ(before->frames.size(), 24u) << "what plays keeps its own";
  EXPECT_EQ(after->frames.size(), 12u);
}

}  // namespace
}  // namespace fb::audio
