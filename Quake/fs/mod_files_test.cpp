#include "fs/mod_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "fs/test_files.h"

namespace fb::fs {
namespace {

using testing::HasSubstr;
namespace stdfs = std::filesystem;

class ModFilesTest : public testing::Test {
 protected:
  ModFilesTest() : files_(open()) {}
  FileSystem open() const {
    base.put("game/id1/progs.dat", "code");
    FsOptions options;
    options.base_dir = base.path() / "game";
    options.user_dir = base.path() / "home";
    auto files = FileSystem::open(options);
    FB_CHECK(files.ok());
    return *std::move(files);
  }
  static std::string refusal(const Status& status) { return status ? "written" : status.error().message; }
  std::string write(ModFiles& files, const std::string& name, std::size_t size = 1) const {
    return refusal(files.write(name, Bytes(size, 'x')));
  }
  const TestDirectory base;
  const FileSystem files_;
};

TEST_F(ModFilesTest, WritesAndReads) {
  ModFiles mod(files_);
  EXPECT_EQ(write(mod, "data/a/b.txt", 3), "written");
  mod.flush();
  EXPECT_EQ(as_text(*mod.read("data/a/b.txt")), "xxx");
  for (int i = 0; i < 40; ++i) EXPECT_EQ(write(mod, fmt::format("data/{}", i)), "written");
  mod.flush();
  EXPECT_EQ(as_text(*mod.read("data/39")), "x");
}

TEST_F(ModFilesTest, TheirNumberIsLimitedOverRestarts) {
  for (int i = 1; i < 20; ++i) base.put(fmt::format("home/id1/data/{}/{}", i % 7, i), "x");
  ModFiles mod(files_, {.files = 20});
  EXPECT_EQ(write(mod, "data/last"), "written");
  EXPECT_THAT(write(mod, "data/one more"), HasSubstr("data/one more: not written: a mod may keep 20 files"));
  EXPECT_FALSE(stdfs::exists(base.path() / "home/id1/data/one more"));
  EXPECT_EQ(write(mod, "data/last", 2), "written") << "one that is there may be written";
  stdfs::remove(base.path() / "home/id1/data/0/7");
  mod.flush();
  EXPECT_EQ(write(mod, "data/one more"), "written") << "the next level counts anew";
}

TEST_F(ModFilesTest, SoIsTheirSum) {
  base.put("home/id1/data/large", std::string(900, 'x'));
  ModFiles mod(files_, {.bytes = 1000});
  EXPECT_EQ(write(mod, "data/a", 60), "written");
  EXPECT_EQ(write(mod, "data/a", 100), "written") << "it replaces the first";
  EXPECT_THAT(write(mod, "data/b", 1), HasSubstr("a mod may keep 1000 bytes in all its files"));
  EXPECT_EQ(write(mod, "data/a", 10), "written");
  EXPECT_EQ(write(mod, "data/b", 90), "written");
}

TEST_F(ModFilesTest, AndTheDepthOfItsFolders) {
  ModFiles mod(files_);
  EXPECT_EQ(write(mod, "data/1/2/3/4/5/6/7/x"), "written");
  EXPECT_THAT(write(mod, "data/1/2/3/4/5/6/7/8/x"), HasSubstr("at most 8 folders deep"));
}

}  // namespace
}  // namespace fb::fs
