#include "fs/zip.h"

#include <gmock/gmock.h>

#include <array>
#include <thread>

#include "fs/test_files.h"
#include "fs/test_zips.h"

namespace fb::fs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::unique_ptr<Zip> opened(const std::vector<ZippedFile>& files) {
  auto zip = Zip::open(FileData(make_zip(files)), "test.pk3");
  EXPECT_TRUE(zip) << zip.error().message;
  return zip ? *std::move(zip) : nullptr;
}
// The file's text, or the cause of an error.
std::string read(const Zip& zip, std::string_view name) {
  const PakEntry* entry = zip.find(name);
  if (!entry) return "no such file";
  const auto data = zip.read(*entry);
  return data ? std::string(data->text()) : data.error().message;
}

TEST(Zip, FilesStoredAndDeflated) {
  const auto zip = opened({{"maps/a.bsp", "alpha"},
                           {"maps/", ""},
                           {"gfx\\b.lmp", "beta", deflated("beta"), 8},
                           {"empty", ""},
                           {"xs", std::string(50, 'x'), std::string("\xab\xa8\x20\x15\x00\x00", 6), 8}});  // by zlib
  EXPECT_EQ(zip->left_out(), "");
  EXPECT_EQ(zip->entries().size(), 4u);
  EXPECT_EQ(read(*zip, "maps/a.bsp"), "alpha");
  EXPECT_EQ(read(*zip, "gfx/b.lmp"), "beta");
  EXPECT_EQ(read(*zip, "empty"), "");
  EXPECT_EQ(read(*zip, "xs"), std::string(50, 'x'));
  EXPECT_EQ(zip->find("MAPS/a.bsp"), nullptr);
  EXPECT_EQ(zip->find_ignoring_case("MAPS/A.bsp"), zip->find("maps/a.bsp"));
  EXPECT_EQ(zip->find("maps/c.bsp"), nullptr);
  const PakEntry& entry = *zip->find("gfx/b.lmp");
  EXPECT_EQ(zip->read(entry, 1, 2)->text(), "et");
  EXPECT_EQ(zip->read(entry, 3, 9)->text(), "a");
  EXPECT_EQ(zip->read(entry, 9, 9)->text(), "");
}

TEST(Zip, FromTheDisk) {
  const TestDirectory directory;
  directory.put("x.pk3", make_zip({{"a", "alpha"}}));
  const auto zip = Zip::open(directory.path() / "x.pk3", "id1/x.pk3");
  ASSERT_TRUE(zip) << zip.error().message;
  EXPECT_EQ(read(**zip, "a"), "alpha");
  EXPECT_THAT(Zip::open(directory.path() / "none.pk3", "id1/none.pk3").error().message, StartsWith("id1/none.pk3: "));
  directory.put("text.pk3", std::string_view("no archive at all"));
  EXPECT_THAT(Zip::open(directory.path() / "text.pk3", "id1/text.pk3").error().message,
              StartsWith("id1/text.pk3: not a zip archive that can be read: "));
}

// A bad file costs itself.
TEST(Zip, LeavesOutWhatIsNotSound) {
  const auto first_fault = [](const ZippedFile& bad) {
    const auto zip = opened({{"good", "alpha"}, bad, {"also_good", "beta"}});
    EXPECT_EQ(read(*zip, "good"), "alpha");
    EXPECT_EQ(read(*zip, "also_good"), "beta");
    EXPECT_EQ(zip->entries().size(), 2u);
    const std::string start = "test.pk3: 1 of 3 files are left out; the first is ";
    EXPECT_THAT(zip->left_out(), StartsWith(start));
    return zip->left_out().substr(std::min(start.size(), zip->left_out().size()));
  };
  for (const char* name : {"../x", "/etc/x", "a/../../x", "c:x", "..\\x"})
    EXPECT_EQ(first_fault({name, "x"}), "\"" + std::string(name) + "\": its name leads outside of the game");
  EXPECT_EQ(first_fault({"good", "second"}), "\"good\": there is another of its name");
  EXPECT_EQ(first_fault({"bzip", "x", "x", 12}),
            "\"bzip\": it is packed by method 12; stored and deflated files are read");
  EXPECT_EQ(first_fault({"secret", "x", "x", 0, 1}), "\"secret\": it is encrypted");
  EXPECT_EQ(first_fault({"huge", "x", deflated("x"), 8, 0, 0xfffffff0u}),
            "\"huge\": it claims 4294967280 bytes, of 536870912 that are read");
  EXPECT_EQ(first_fault({"bomb", "x", deflated("x"), 8, 0, 7000}),
            "\"bomb\": it claims 7000 bytes, and 6 packed ones cannot hold them");
  EXPECT_EQ(first_fault({"short", "x", "x", 0, 0, 2}),
            "\"short\": it claims 2 bytes, and 1 packed ones cannot hold them");
}

TEST(Zip, FilesThatAreNotWhatTheyClaim) {
  const auto zip = opened({{"good", "alpha"},
                           {"longer", "abcdefgh", deflated("abc"), 8},
                           {"shorter", "abc", deflated("abcdefgh"), 8, 0, 3},
                           {"garbage", "abc", "\xff\xff\xff\xff", 8},
                           {"changed", "abc", "abd"}});
  EXPECT_EQ(read(*zip, "good"), "alpha");
  for (const char* name : {"longer", "shorter", "garbage", "changed"})
    EXPECT_THAT(read(*zip, name), StartsWith("test.pk3:" + std::string(name) + ": ")) << name;
}

TEST(Zip, EveryTruncationIsRefusedOrReadsNothingWrong) {
  const Bytes good = make_zip({{"a", "alpha"}, {"b", "beta", deflated("beta"), 8}});
  for (std::size_t size = 1; size < good.size(); ++size) {
    const auto zip = Zip::open(FileData(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), "cut");
    ASSERT_FALSE(zip) << size;
    EXPECT_THAT(zip.error().message, StartsWith("cut: not a zip archive that can be read: "));
  }
}

TEST(Zip, ThreadsMayRead) {
  std::vector<ZippedFile> files;
  for (int i = 0; i < 20; ++i)
    files.push_back({"file" + std::to_string(i), std::string(5000, static_cast<char>('a' + i))});
  const auto zip = opened(files);
  std::vector<std::thread> threads;
  std::array<int, 4> right{};
  for (int& count : right) {
    threads.emplace_back([&] {
      for (const ZippedFile& file : files) count += read(*zip, file.name) == file.text ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(right, testing::Each(20));
}

}  // namespace
}  // namespace fb::fs
