#include "fs/file.h"

#include <gmock/gmock.h>

#include <array>

#include "fs/test_files.h"

namespace fb::fs {
namespace {

using testing::HasSubstr;

Bytes bytes_of(std::string_view text) { return Bytes(text.begin(), text.end()); }

TEST(File, ReadsAtOffsets) {
  const TestDirectory directory;
  directory.put("x", "0123456789");
  const auto file = RandomAccessFile::open(directory.path() / "x");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->size(), 10u);
  std::array<std::uint8_t, 3> part{};
  ASSERT_TRUE(file->read_at(4, part));
  EXPECT_EQ(std::string(part.begin(), part.end()), "456");
  const auto past = file->read_at(8, part);
  ASSERT_FALSE(past);
  EXPECT_THAT(past.error().message, HasSubstr("offset 10: the file ends, 1 bytes short"));
}

TEST(File, MissingFilesAndDirectoriesAreErrors) {
  const TestDirectory directory;
  EXPECT_FALSE(RandomAccessFile::open(directory.path() / "none"));
  EXPECT_FALSE(RandomAccessFile::open(directory.path()));
  EXPECT_FALSE(read_whole_file(directory.path() / "none"));
}

TEST(File, WritesReplaceAndMakeDirectories) {
  const TestDirectory directory;
  const auto path = directory.path() / "a" / "b" / "config.cfg";
  ASSERT_TRUE(write_file_atomically(path, bytes_of("a longer first text")));
  ASSERT_TRUE(write_file_atomically(path, bytes_of("second")));
  EXPECT_EQ(as_text(*read_whole_file(path)), "second");
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path.parent_path())) ++count;
  EXPECT_EQ(count, 1) << "a temporary file was left behind";
}

TEST(File, AFailedWriteKeepsTheOldAndSaysWhy) {
  const TestDirectory directory;
  directory.put("taken/inside", "x");  // a directory that is not empty, in the place of the file
  const auto status = write_file_atomically(directory.path() / "taken", bytes_of("y"));
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("taken: cannot be written"));
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory.path())) ++count;
  EXPECT_EQ(count, 1) << "a temporary file was left behind";
  directory.put("file", "x");
  EXPECT_FALSE(write_file_atomically(directory.path() / "file" / "below", bytes_of("y")));
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "file")), "x");
}

// On Windows the system's own names are UTF-16, and a program's text is in a code page.
TEST(File, NamesAreUtf8) {
  const TestDirectory directory;
  for (const std::string name : {"\xc5\xbc\xc3\xb3\xc5\x82w", "\xe4\xba\x80",
                                 "\xf0\x9f\x90\xa2 of\xc2\xa0"
                                 "4 bytes"}) {
    ASSERT_TRUE(write_file_atomically(directory.path() / name, bytes_of(name)));
    EXPECT_EQ(as_text(*read_whole_file(directory.file(name))), name);
    std::filesystem::directory_iterator entry(directory.path());
    EXPECT_EQ(entry->path().filename().string(), name);
    EXPECT_TRUE(entry->path().filename() == std::u8string(name.begin(), name.end())) << name;
    std::filesystem::remove(entry->path());
  }
}

TEST(File, WhatIsReadMayBeReplaced) {
  const TestDirectory directory;
  directory.put("x", "former");
  const auto former = RandomAccessFile::open(directory.path() / "x");
  ASSERT_TRUE(former);
  ASSERT_TRUE(write_file_atomically(directory.path() / "x", bytes_of("new")));
  EXPECT_EQ(as_text(*former->read(0, former->size())), "former");
  EXPECT_EQ(as_text(*read_whole_file(directory.path() / "x")), "new");
}

}  // namespace
}  // namespace fb::fs
