// Recorded files are read back, and a disk that is full is told of.
#include "audio/wav_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/test_directory.h"
#include "formats/wav.h"

namespace fb::audio {
namespace {

Bytes bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(WavWriter, WritesWhatAReaderReads) {
  const TestDirectory directory;
  auto writer = WavWriter::create(directory.path() / "mix.wav", 44100);
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer->write(std::vector<float>{0.0f, 0.0f, 1.0f, 1.0f}).ok());
  ASSERT_TRUE(writer->write(std::vector<float>{-1.0f, -1.0f, 0.5f, 0.25f, 2.0f, -2.0f}).ok());
  ASSERT_TRUE(writer->finish().ok());
  const Bytes bytes = bytes_of(directory.path() / "mix.wav");
  ASSERT_EQ(bytes.size(), 44u + 5 * 4);
  const auto wav = formats::parse_wav(bytes, "mix.wav");
  ASSERT_TRUE(wav.ok()) << wav.error().message;
  EXPECT_EQ(wav->rate, 44100u);
  EXPECT_EQ(wav->channels, 2);
  EXPECT_THAT(wav->samples, ::testing::ElementsAre(0, 32767, -32767, (16384 + 8192) / 2, 0));
}

TEST(WavWriter, NamesWhatItCannotWrite) {
  const auto nowhere = WavWriter::create("no such folder/mix.wav", 44100);
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().message, "no such folder/mix.wav.part: cannot be written: No such file or directory");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  auto full = WavWriter::create("/dev/full", 44100);
  const Status status = full.ok() ? full->write(std::vector<float>(100000)) : Status(full.error());
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "/dev/full: cannot be written: No space left on device");
}

// A program that is killed keeps nothing open and finishes nothing.
TEST(WavWriter, AKilledRecordingLeavesTheFormerFile) {
  const TestDirectory directory;
  const auto path = directory.path() / "mix.wav", part = directory.path() / "mix.wav.part";
  for (const std::size_t frames : {10u, 20u}) {
    auto writer = WavWriter::create(path, 44100);
    ASSERT_TRUE(writer && writer->write(std::vector<float>(2 * frames)));
    const auto grown = formats::parse_wav(bytes_of(part), "mix.wav.part");
    ASSERT_TRUE(grown) << grown.error().message;
    EXPECT_EQ(grown->samples.size(), frames) << "what is there is whole";
    if (frames == 10u) {
      ASSERT_TRUE(writer->finish());
    }
  }
  EXPECT_EQ(std::filesystem::file_size(path), 44u + 40u);
  EXPECT_TRUE(std::filesystem::exists(part));
  auto next = WavWriter::create(path, 44100);
  ASSERT_TRUE(next && next->write(std::vector<float>(60)) && next->finish());
  EXPECT_EQ(std::filesystem::file_size(path), 44u + 120u);
  EXPECT_FALSE(std::filesystem::exists(part));
}

TEST(WavWriter, WhoseFileMayNotGrowKeepsTheFormerOne) {
  const TestDirectory directory;
  const auto path = directory.path() / "mix.wav", part = directory.path() / "mix.wav.part";
  const auto record = [&](rlim_t limit) {
    rlimit former{};
    ::getrlimit(RLIMIT_FSIZE, &former);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    auto writer = WavWriter::create(path, 44100);
    ASSERT_TRUE(writer && writer->write(std::vector<float>(200)));
    const rlimit small{limit, former.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const Status status = writer->write(std::vector<float>(2000));
    const Status end = writer->finish();
    ::setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, ignored);
    EXPECT_FALSE(status) << "the limit is in the middle of a frame";
    EXPECT_TRUE(end);
  };
  record(1001);
  EXPECT_EQ(std::filesystem::file_size(path), 44u + 400u) << "what is whole";
  record(2001);
  EXPECT_EQ(std::filesystem::file_size(path), 44u + 400u);
  const auto cut = formats::parse_wav(bytes_of(part), "mix.wav.part");
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_EQ(cut->samples.size(), 100u);
}

TEST(WavWriter, LeavesAnotherProgramsRecordingAlone) {
  const TestDirectory directory;
  auto first = WavWriter::create(directory.path() / "mix.wav", 44100);
  ASSERT_TRUE(first.ok() && first->write(std::vector<float>(200)));
  const auto second = WavWriter::create(directory.path() / "mix.wav", 44100);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message, ::testing::EndsWith("mix.wav.part: another program is writing it"));
  EXPECT_EQ(std::filesystem::file_size(directory.path() / "mix.wav.part"), 44u + 400u);
}

}  // namespace
}  // namespace fb::audio
