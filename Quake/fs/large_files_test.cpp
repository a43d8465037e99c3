// Files of two gigabytes, loose and in paks: reading their beginning costs time and memory for the beginning only.
#include <gmock/gmock.h>

#include "base/test_memory.h"
#include "fs/file.h"
#include "fs/filesystem.h"
#include "fs/test_files.h"
#include "fs/test_large_files.h"

namespace fb::fs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::uint64_t kLittle = 32u << 20u;  // bytes

class LargeFiles : public testing::Test {
 protected:
  FileSystem open() const {
    FsOptions options;
    options.base_dir = directory_.path();
    options.user_dir.emplace();
    return *FileSystem::open(options);
  }
  TestDirectory directory_;
};

TEST_F(LargeFiles, CostOnlyWhatIsLookedAt) {
  if (!put_large_pak(directory_.path() / "id1" / "pak0.pak", "packed", "IDPO") ||
      !put_large(directory_.path() / "id1" / "loose", "WAD2"))
    GTEST_SKIP() << "the file system has no room for sparse files of 2 GB";
  const FileSystem files = open();
  for (const auto& [name, magic] : {std::pair("packed", "IDPO"), std::pair("loose", "WAD2")}) {
    const std::uint64_t before = resident_bytes();
    const std::uint64_t read_before = bytes_read();
    const auto data = files.load(name);
    ASSERT_TRUE(data) << data.error().message;
    EXPECT_EQ(data->size(), kLargeSize);
    EXPECT_EQ(data->text().substr(0, 4), magic);
    EXPECT_EQ(data->text().back(), '\0');
    EXPECT_LT(bytes_read(), read_before + kLittle) << name;
    EXPECT_LT(resident_bytes(), before + kLittle) << name;
  }
}

TEST_F(LargeFiles, StayWhereSomebodyHoldsThem) {
  ASSERT_TRUE(put_large(directory_.path() / "x", "begin", 2 * kMostReadWhole));
  FileData kept;
  {
    const auto file = RandomAccessFile::open(directory_.path() / "x");
    ASSERT_TRUE(file);
    const auto part = file->read(2, kMostReadWhole + 1);  // no page begins there
    ASSERT_TRUE(part);
    kept = *part;
  }
  std::filesystem::remove(directory_.path() / "x");
  EXPECT_EQ(kept.size(), kMostReadWhole + 1);
  EXPECT_EQ(kept.text().substr(0, 3), "gin");
  EXPECT_EQ(kept.text().back(), '\0');
}

TEST_F(LargeFiles, ThoseThatWereCutAreErrorsWhenTheyAreRead) {
  ASSERT_TRUE(put_large(directory_.path() / "x", "begin", 4 * kMostReadWhole));
  const auto file = RandomAccessFile::open(directory_.path() / "x");
  ASSERT_TRUE(file);
  std::filesystem::resize_file(directory_.path() / "x", 100);
  for (const std::uint64_t size : {kMostReadWhole / 2, 2 * kMostReadWhole}) {
    const auto part = file->read(50, size);
    ASSERT_FALSE(part);
    EXPECT_THAT(part.error().message, HasSubstr("offset 100: the file ends, "));
    EXPECT_THAT(part.error().message, HasSubstr(std::to_string(size - 50) + " bytes short"));
  }
}

TEST_F(LargeFiles, APaksDirectoryHasALimit) {
  Bytes header = {'P', 'A', 'C', 'K'};
  append_u32(header, 12);
  append_u32(header, kLargeSize / 64 * 64);
  const std::string_view text(reinterpret_cast<const char*>(header.data()), header.size());
  if (!put_large(directory_.path() / "x.pak", text, 12ull + kLargeSize))
    GTEST_SKIP() << "the file system has no room for sparse files of 2 GB";
  const auto pak = Pak::open(directory_.path() / "x.pak", "id1/x.pak");
  ASSERT_FALSE(pak);
  EXPECT_THAT(pak.error().message, StartsWith("id1/x.pak: offset 8: a directory of 33554428 files, of 262144"));
}

}  // namespace
}  // namespace fb::fs
