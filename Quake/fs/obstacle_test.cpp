#include "fs/obstacle.h"

#include <gmock/gmock.h>

#include "fs/filesystem.h"
#include "fs/test_files.h"
#include "fs/test_log.h"
#include "fs/test_permissions.h"

namespace fb::fs {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
namespace stdfs = std::filesystem;

class ObstacleTest : public testing::Test {
 protected:
  ObstacleTest() {
    stdfs::permissions(base.path(), stdfs::perms::all);  // so that any user can enter it
    base.put("id1/maps/start.bsp", "a map");
    base.put("id1/pak0.pak", make_pak({{"progs.dat", "code"}}));
    stdfs::create_directory(user());
  }
  stdfs::path user() const { return base.path() / "user"; }
  stdfs::path at(const std::string& name) const { return base.path() / name; }
  Result<FileSystem> open() const {
    FsOptions options;
    options.base_dir = base.path();
    options.user_dir = user();
    return FileSystem::open(options);
  }
  // Why it does not open.
  std::string refused() const {
    const auto files = open();
    return files ? "it opens" : files.error().message;
  }
  void replace_by_link(const std::string& name, const std::string& target) const {
    stdfs::remove_all(at(name));
    stdfs::create_symlink(target, at(name));
  }
  const TestDirectory base;
};

TEST_F(ObstacleTest, AbsenceIsNone) {
  EXPECT_EQ(look_at(at("id1/none")).standing, Standing::kAbsent);
  EXPECT_EQ(look_at(at("id1/pak0.pak/below")).standing, Standing::kAbsent);
  EXPECT_EQ(look_at(at(std::string(5000, 'x'))).standing, Standing::kAbsent);
  EXPECT_EQ(look_at(at("id1/pak0.pak")).standing, Standing::kFile);
  EXPECT_EQ(look_at(at("id1")).standing, Standing::kDirectory);
  for (const char* name : {"none", "maps/none.bsp", "none/start.bsp", "pak0.pak/below", "maps/start.bsp"})
    EXPECT_FALSE(find_obstacle(at("id1"), name)) << name;
}

TEST_F(ObstacleTest, WhatIsNoFileIsNamed) {
  stdfs::create_directory(at("id1/maps/folder.bsp"));
  stdfs::create_symlink("elsewhere.bsp", at("id1/maps/link.bsp"));
  stdfs::create_symlink("round.bsp", at("id1/maps/round.bsp"));
  const auto cause = [&](const char* name) { return find_obstacle(at("id1"), name).value_or(Error{}).message; };
  EXPECT_THAT(cause("maps/folder.bsp"), EndsWith("id1/maps/folder.bsp: cannot be read: it is a directory"));
  EXPECT_THAT(cause("maps/link.bsp"), EndsWith("cannot be read: it is a link to elsewhere.bsp, and nothing is there"));
  EXPECT_THAT(cause("maps/round.bsp"), EndsWith("cannot be read: Too many levels of symbolic links"));
}

TEST_F(ObstacleTest, APakThatIsThereAndCannotBeReadIsAnError) {
  base.put("good.pak", make_pak({}));
  replace_by_link("id1/pak0.pak", "../good.pak");
  EXPECT_EQ(refused(), "it opens") << "a link to a pak is one";
  replace_by_link("id1/pak0.pak", "../gone.pak");
  EXPECT_THAT(refused(), EndsWith("id1/pak0.pak: cannot be read: it is a link to ../gone.pak, and nothing is there"));
  stdfs::remove(at("id1/pak0.pak"));
  stdfs::create_directory(at("id1/PAK0.PAK"));
  EXPECT_THAT(refused(), EndsWith("id1/PAK0.PAK: cannot be read: it is a directory"));
  stdfs::remove(at("id1/PAK0.PAK"));
  base.put("id1/pak0.pak", "PACK\x0c\x00");
  EXPECT_THAT(refused(), HasSubstr("id1/pak0.pak: offset"));
}

TEST_F(ObstacleTest, AGameFolderThatIsNoneIsAnError) {
  replace_by_link("id1", "gone");
  EXPECT_THAT(refused(), EndsWith("id1: cannot be read: it is a link to gone, and nothing is there"));
  stdfs::remove(at("id1"));
  base.put("id1", "a file");
  EXPECT_THAT(refused(), EndsWith("id1: cannot be read: it is a file, not a directory"));
}

TEST_F(ObstacleTest, AFileIsNamedWhenItIsAskedFor) {
  const auto files = open();
  ASSERT_TRUE(files);
  stdfs::create_symlink("gone.bsp", at("id1/maps/link.bsp"));
  LogLines log;
  EXPECT_FALSE(files->read("maps/link.bsp"));
  EXPECT_FALSE(files->read("maps/link.bsp"));
  EXPECT_THAT(log.lines, ElementsAre(HasSubstr("maps/link.bsp: cannot be read: it is a link to gone.bsp")));
  EXPECT_THAT(files->load("maps/link.bsp").error().message, HasSubstr("it is a link to gone.bsp"));
  EXPECT_FALSE(files->obstacle("maps/start.bsp"));
  EXPECT_FALSE(files->obstacle("progs.dat"));
  EXPECT_FALSE(files->obstacle("maps/none.bsp"));
  base.put("user/id1/maps/link.bsp", "found elsewhere");
  EXPECT_FALSE(files->obstacle("maps/link.bsp"));
  EXPECT_TRUE(files->read("maps/link.bsp"));
}

// Permissions, for a user who is not root.
class PermissionTest : public ObstacleTest {
 protected:
  void SetUp() override {
    const PermissionsCount count;
    if (!count) GTEST_SKIP() << "root cannot become nobody here";
  }
};

TEST_F(PermissionTest, AGameFolder) {
  {
    const WithPermissions none(at("id1"), 0000);
    const PermissionsCount count;
    EXPECT_THAT(refused(), EndsWith("id1: cannot be read: Permission denied"));
  }
  {
    const WithPermissions none(at("id1"), 0444);
    const PermissionsCount count;
    EXPECT_THAT(refused(), EndsWith("id1: cannot be read: Permission denied")) << "listed, not reached";
  }
  {
    const WithPermissions none(base.path(), 0000);
    const PermissionsCount count;
    EXPECT_THAT(refused(), EndsWith("id1: cannot be read: Permission denied")) << "nor what it stands in";
  }
  const WithPermissions none(at("id1"), 0111);
  const PermissionsCount count;
  LogLines log;
  const auto files = open();
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(log.lines, ElementsAre(EndsWith("id1: cannot be listed: Permission denied")));
  EXPECT_TRUE(files->read("progs.dat"));
  EXPECT_TRUE(files->read("maps/start.bsp"));
}

TEST_F(PermissionTest, APak) {
  const WithPermissions none(at("id1/pak0.pak"), 0000);
  const PermissionsCount count;
  EXPECT_THAT(refused(), EndsWith("id1/pak0.pak: cannot be opened: Permission denied"));
}

TEST_F(PermissionTest, AFolderOfFiles) {
  const WithPermissions none(at("id1/maps"), 0000);
  const PermissionsCount count;
  LogLines log;
  const auto files = open();
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(log.lines, ElementsAre(EndsWith("id1/maps: cannot be read: Permission denied"))) << "at the start";
  EXPECT_FALSE(files->read("maps/start.bsp"));
  EXPECT_FALSE(files->read("maps/another.bsp"));
  EXPECT_THAT(log.lines, SizeIs(2)) << "and once more where it is missed";
  EXPECT_THAT(files->obstacle("maps/start.bsp")->message, EndsWith("id1/maps: cannot be read: Permission denied"));
}

TEST_F(PermissionTest, AFile) {
  const WithPermissions none(at("id1/maps/start.bsp"), 0000);
  const PermissionsCount count;
  LogLines log;
  const auto files = open();
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(log.lines, IsEmpty());
  EXPECT_FALSE(files->read("maps/start.bsp"));
  EXPECT_THAT(log.lines, ElementsAre(EndsWith("maps/start.bsp: cannot be opened: Permission denied")));
  EXPECT_THAT(files->obstacle("maps/start.bsp")->message, EndsWith("cannot be opened: Permission denied"));
}

TEST_F(PermissionTest, ThePlayersOwnFolderIsLeftOut) {
  base.put("user/id1/config.cfg", "mine");
  const WithPermissions none(user(), 0000);
  const PermissionsCount count;
  LogLines log;
  const auto files = open();
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_THAT(log.lines,
              ElementsAre(EndsWith("user/id1: cannot be read: Permission denied; what the player has there is "
                                   "left out")));
  EXPECT_TRUE(files->read("progs.dat"));
  EXPECT_THAT(files->write("s0.sav", Bytes{1}).error().message, HasSubstr("Permission denied"));
}

}  // namespace
}  // namespace fb::fs
