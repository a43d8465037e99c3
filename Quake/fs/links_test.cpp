#include "fs/links.h"

#include <gmock/gmock.h>

#include "fs/filesystem.h"
#include "fs/test_files.h"
#include "fs/test_log.h"

namespace fb::fs {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;
namespace stdfs = std::filesystem;

// A user's folder with a game in it, and things beside it that no mod may touch.
class LinksTest : public testing::Test {
 protected:
  LinksTest() {
    base.put("game/id1/progs.dat", "code");
    base.put("home/id1/autoexec.cfg", "");
    base.put("outside/secret", "secret");
    base.put("outside/dotfiles/quake.cfg", "old");
  }
  stdfs::path at(const std::string& name) const { return base.path() / name; }
  void link(const std::string& name, const stdfs::path& target) const {
    stdfs::create_directories(at(name).parent_path());
    stdfs::create_symlink(target, at(name));
  }
  FileSystem open() const {
    FsOptions options;
    options.base_dir = at("game");
    options.user_dir = at("home");
    auto files = FileSystem::open(options);
    FB_CHECK(files.ok());
    return *std::move(files);
  }
  Status write(const std::string& name) const {
    return open().write(name, ByteView(reinterpret_cast<const std::uint8_t*>("new"), 3));
  }
  std::string text(const std::string& name) const {
    const auto data = read_whole_file(at(name));
    return data ? as_text(*data) : "(none)";
  }
  const TestDirectory base;
};

TEST_F(LinksTest, WritingNeverLeadsOut) {
  link("home/id1/s0.sav", at("outside/secret"));
  link("home/id1/up.sav", "../../outside/secret");
  link("home/id1/new.sav", at("outside/not yet"));
  link("home/id1/twice.sav", "up.sav");
  link("home/id1/data", at("outside"));
  link("home/id1/data2", "../../outside");
  link("home/id1/here/back", "../../id1/../../outside");
  link("home/id1/round", "round");
  for (const char* name : {"s0.sav", "up.sav", "new.sav", "twice.sav", "data/secret", "data/fresh", "data2/a/b",
                           "here/back/secret", "round", "round/x"}) {
    const Status status = write(name);
    ASSERT_FALSE(status) << name;
    EXPECT_THAT(status.error().message, testing::AnyOf(HasSubstr("a link leads out of the game's folder"),
                                                       HasSubstr("its links lead in a circle")))
        << name;
  }
  EXPECT_EQ(text("outside/secret"), "secret");
  EXPECT_FALSE(stdfs::exists(at("outside/not yet")) || stdfs::exists(at("outside/fresh")) ||
               stdfs::exists(at("outside/a")));
}

TEST_F(LinksTest, ALinkWithinTheGameIsFollowed) {
  link("home/id1/shots", "screenshots");
  link("home/id1/old.sav", "s0.sav");
  link("home/id1/whole", at("home/id1/saves"));
  ASSERT_TRUE(write("shots/x.png"));
  EXPECT_EQ(text("home/id1/screenshots/x.png"), "new");
  ASSERT_TRUE(write("old.sav"));
  EXPECT_EQ(text("home/id1/s0.sav"), "new");
  EXPECT_TRUE(stdfs::is_symlink(at("home/id1/old.sav")));
  ASSERT_TRUE(write("whole/y.sav"));
  EXPECT_EQ(text("home/id1/saves/y.sav"), "new");
}

TEST_F(LinksTest, TheFoldersThemselvesMayBeLinks) {
  stdfs::rename(at("home/id1"), at("outside/id1"));
  link("home/id1", at("outside/id1"));
  stdfs::rename(at("home"), at("outside/home"));
  link("home", "outside/home");
  ASSERT_TRUE(write("s0.sav"));
  EXPECT_EQ(text("outside/id1/s0.sav"), "new");
  link("outside/id1/s1.sav", at("outside/secret"));
  EXPECT_FALSE(write("s1.sav"));
}

TEST_F(LinksTest, AConfigurationMayBeKeptElsewhere) {
  link("home/id1/config.cfg", "../../outside/dotfiles/quake.cfg");
  ASSERT_TRUE(write("config.cfg"));
  EXPECT_TRUE(stdfs::is_symlink(at("home/id1/config.cfg")));
  EXPECT_EQ(text("outside/dotfiles/quake.cfg"), "new");
  EXPECT_EQ(*open().write_path("config.cfg"), stdfs::canonical(at("outside/dotfiles/quake.cfg")));
}

TEST_F(LinksTest, AConfigurationIsNotWrittenOverAnythingElse) {
  stdfs::create_directory(at("outside/folder.cfg"));
  for (const char* target : {"outside/secret", "outside/.profile", "outside/none/x.cfg", "outside/folder.cfg"}) {
    link("home/id1/config.cfg", at(target));
    EXPECT_FALSE(write("config.cfg")) << target;
    stdfs::remove(at("home/id1/config.cfg"));
  }
  link("home/id1/autoexec2.cfg", at("outside/dotfiles/quake.cfg"));
  EXPECT_FALSE(write("autoexec2.cfg"));
  link("home/id1/sub/config.cfg", at("outside/dotfiles/quake.cfg"));
  EXPECT_FALSE(write("sub/config.cfg"));
  EXPECT_EQ(text("outside/dotfiles/quake.cfg"), "old");
  EXPECT_FALSE(stdfs::exists(at("outside/.profile")) || stdfs::exists(at("outside/none")));
}

TEST_F(LinksTest, AModReadsNothingOutside) {
  base.put("home/id1/data/own.txt", "own");
  base.put("game/id1/maps/list.txt", "list");
  link("home/id1/data/key", at("outside/secret"));
  link("home/id1/data/all", at("outside"));
  link("home/id1/maps", at("game/id1/maps"));
  link("home/id1/data/same", "own.txt");
  const FileSystem files = open();
  const auto read = [&](std::string_view name) {
    const auto data = files.read_for_mod(name);
    return data ? as_text(*data) : "(none)";
  };
  const LogLines log;
  EXPECT_EQ(read("data/own.txt"), "own");
  EXPECT_EQ(read("data/same"), "own");
  EXPECT_EQ(read("maps/list.txt"), "list") << "among the folders that are searched";
  EXPECT_EQ(read("progs.dat"), "code");
  EXPECT_EQ(read("none"), "(none)");
  EXPECT_THAT(log.lines, SizeIs(0));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(read("data/key"), "(none)");
    EXPECT_EQ(read("data/all/secret"), "(none)");
  }
  EXPECT_THAT(log.lines, SizeIs(2)) << "each once";
  EXPECT_THAT(log.lines, Contains(HasSubstr("data/key: not read for the mod: a link leads out")));
  EXPECT_EQ(as_text(*files.read("data/key")), "secret") << "the user's own commands are free to";
}

TEST_F(LinksTest, WhereThereIsNoLinkThePathIsAsItWasNamed) {
  const auto followed = follow_links("some/folder", "a/b");
  ASSERT_TRUE(followed);
  EXPECT_FALSE(followed->by_link);
  EXPECT_EQ(followed->path, stdfs::path("some/folder/a/b"));
  EXPECT_TRUE(is_within(at("home/id1/x"), at("home/id1")));
  EXPECT_FALSE(is_within(at("home/id1"), at("home/id1")));
  EXPECT_FALSE(is_within(at("home/id11/x"), at("home/id1")));
}

}  // namespace
}  // namespace fb::fs
