// Recorded files are read back, and a disk that is full is told of.
#include "audio/wav_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_EQ(nowhere.error().message, "no such folder/mix.wav: cannot be written: No such file or directory");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  auto full = WavWriter::create("/dev/full", 44100);
  const Status status = full.ok() ? full->write(std::vector<float>(100000)) : Status(full.error());
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "/dev/full: cannot be written: No space left on device");
}

TEST(WavWriter, LeavesAnotherProgramsRecordingAlone) {
  const TestDirectory directory;
  auto first = WavWriter::create(directory.path() / "mix.wav", 44100);
  ASSERT_TRUE(first.ok() && first->write(std::vector<float>(200)));
  const auto second = WavWriter::create(directory.path() / "mix.wav", 44100);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message, ::testing::EndsWith("mix.wav: another program is writing it"));
  EXPECT_EQ(std::filesystem::file_size(directory.path() / "mix.wav"), 44u + 400u);
}

}  // namespace
}  // namespace fb::audio
