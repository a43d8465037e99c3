#include "fs/filesystem.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <optional>

#include "base/librequake.h"
#include "fs/test_files.h"
#include "fs/test_log.h"
#include "fs/test_permissions.h"
#include "fs/test_zips.h"

namespace fb::fs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

FileSystem open(const FsOptions& options) {
  auto files = FileSystem::open(options);
  if (!files) {
    ADD_FAILURE() << files.error().message;
    std::abort();
  }
  return *std::move(files);
}

FsOptions options_for(const TestDirectory& base, std::vector<std::string> games = {}) {
  FsOptions options;
  options.base_dir = base.path();
  options.games = std::move(games);
  options.user_dir.emplace();
  return options;
}

#ifdef __unix__
// The environment without a home while it lives.
class NoHome {
 public:
  NoHome() {
    for (const char* name : {"HOME", "XDG_DATA_HOME"}) {
      const char* value = ::getenv(name);
      before_.emplace_back(name, value ? std::optional<std::string>(value) : std::nullopt);
    }
    ::setenv("HOME", "", 1);
    ::unsetenv("XDG_DATA_HOME");
  }
  ~NoHome() {
    for (const auto& [name, value] : before_) {
      if (value)
        ::setenv(name.c_str(), value->c_str(), 1);
      else
        ::unsetenv(name.c_str());
    }
  }
  NoHome(const NoHome&) = delete;
  NoHome& operator=(const NoHome&) = delete;

 private:
  std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};
#endif

std::string text(const FileSystem& files, std::string_view name) {
  const auto data = files.read(name);
  return data ? as_text(*data) : "(none)";
}

TEST(FileSystem, ArchivesComeBeforePaks) {
  const TestDirectory base;
  base.put("id1/pak0.pak", make_pak({{"a", "pak"}, {"b", "pak"}, {"c", "pak"}}));
  base.put("id1/d", "loose");
  base.put("id1/alpha.pk3", make_zip({{"a", "alpha"}, {"b", "alpha", deflated("alpha"), 8}}));
  base.put("id1/Beta.PK3", make_zip({{"a", "beta"}, {"maps/x.bsp", "a map"}}));
  base.put("id1/beta.pk3.txt", "no archive");
  const FileSystem files = open(options_for(base));
  EXPECT_EQ(text(files, "a"), "beta");
  EXPECT_EQ(text(files, "b"), "alpha");
  EXPECT_EQ(text(files, "B"), "alpha");
  EXPECT_EQ(text(files, "c"), "pak");
  EXPECT_EQ(text(files, "d"), "loose");
  EXPECT_EQ(files.source_of("b"), "id1/alpha.pk3");
  EXPECT_EQ(files.source_of("maps/x.bsp"), "id1/Beta.PK3");
  EXPECT_EQ(as_text(*files.load_part("maps/x.bsp", 2, 3)), "map");
  EXPECT_THAT(files.find("maps/", ".bsp"), SizeIs(1));
  EXPECT_THAT(files.describe(),
              ElementsAre("id1/Beta.PK3 (2 files)", "id1/alpha.pk3 (2 files)", "id1/pak0.pak (3 files)", "id1"));
}

TEST(FileSystem, ArchivesThatCannotBeReadAreToldOfAndLeftOut) {
  const TestDirectory base;
  base.put("id1/a.pk3", make_zip({{"a", "alpha"}, {"../x", "x"}, {"changed", "abc", "abd"}}));
  base.put("id1/b.pk3", "no archive");
  const LogLines log;
  const FileSystem files = open(options_for(base));
  EXPECT_THAT(log.lines, ElementsAre(HasSubstr("id1/a.pk3: 1 of 3 files are left out; the first is \"../x\""),
                                     testing::AllOf(HasSubstr("id1/b.pk3: not a zip archive that can be read"),
                                                    HasSubstr("; it is left out"))));
  EXPECT_EQ(text(files, "a"), "alpha");
  EXPECT_EQ(text(files, "changed"), "(none)");
  EXPECT_THAT(log.lines.back(), HasSubstr("id1/a.pk3:changed: "));
}

TEST(FileSystem, AllFilesOfOneName) {
  const TestDirectory base;
  base.put("id1/x/a", "loose in id1");
  base.put("id1/pak0.pak", make_pak({{"x/a", "pak"}, {"x/b", "other"}}));
  base.put("mod/m.pk3", make_zip({{"x/a", "archive"}}));
  const FileSystem files = open(options_for(base, {"mod"}));
  std::vector<std::string> texts;
  for (const FileData& data : files.read_all("x/a")) texts.push_back(as_text(data));
  EXPECT_THAT(texts, ElementsAre("archive", "pak", "loose in id1"));
  EXPECT_THAT(files.read_all("x/c"), SizeIs(0));
  EXPECT_THAT(files.read_all("../x/a"), SizeIs(0));
  EXPECT_THAT(files.folders(), ElementsAre(base.path()));
}

// A game in the box beside some other data.
struct Boxed {
  TestDirectory box, data;
  Boxed() {
    box.put("id1/progs.dat", "box code");
    box.put("id1/both", "box");
    data.put("id1/both", "data");
  }
  FsOptions options() const {
    FsOptions options = options_for(data);
    options.base_dir_named = true;
    options.base_game = box.path();
    return options;
  }
};

TEST(FileSystem, DataWithoutCodePlaysOnTheBaseGames) {
  const Boxed boxed;
  const FileSystem files = open(boxed.options());
  EXPECT_EQ(text(files, "progs.dat"), "box code");
  EXPECT_EQ(files.source_of("progs.dat"), "basegame/id1");
  EXPECT_TRUE(files.is_of_base_game("progs.dat"));
  EXPECT_EQ(text(files, "both"), "data");
  EXPECT_FALSE(files.is_of_base_game("both"));
  EXPECT_EQ(files.game_index_of("progs.dat"), -1);
  EXPECT_EQ(files.game_index_of("both"), 0);
  EXPECT_FALSE(files.read_own("progs.dat"));
}

TEST(FileSystem, DataWithCodeOfItsOwnSeesNothingOfTheBaseGame) {
  Boxed boxed;
  boxed.box.put("id1/only", "box");
  boxed.data.put("mod/progs.dat", "mod's code");
  FsOptions options = boxed.options();
  options.games = {"mod"};
  const FileSystem files = open(options);
  EXPECT_EQ(text(files, "progs.dat"), "mod's code");
  EXPECT_FALSE(files.exists("only"));
}

TEST(FileSystem, TheBaseGamePlaysWhereNobodyNamedData) {
  Boxed boxed;
  const TestDirectory empty;
  FsOptions options = boxed.options();
  options.base_dir = empty.path();
  EXPECT_FALSE(FileSystem::open(options)) << "a named directory without id1 is a mistake";
  options.base_dir_named = false;
  const FileSystem files = open(options);
  EXPECT_TRUE(files.is_of_base_game("both"));
  EXPECT_EQ(text(files, "both"), "box");
  EXPECT_EQ(files.source_of("both"), "id1");
  options.base_dir = boxed.data.path();
  EXPECT_EQ(text(open(options), "both"), "data") << "data in the current directory comes first";
}

TEST(FileSystem, LaterPaksThenEarlierThenLooseFiles) {
  const TestDirectory base;
  base.put("id1/a", "loose");
  base.put("id1/b", "loose");
  base.put("id1/c", "loose");
  base.put("id1/pak0.pak", make_pak({{"a", "pak0"}, {"b", "pak0"}}));
  base.put("id1/pak1.pak", make_pak({{"a", "pak1"}}));
  const FileSystem files = open(options_for(base));
  EXPECT_EQ(text(files, "a"), "pak1");
  EXPECT_EQ(text(files, "b"), "pak0");
  EXPECT_EQ(text(files, "c"), "loose");
  EXPECT_EQ(files.source_of("a"), "id1/pak1.pak");
  EXPECT_EQ(files.source_of("c"), "id1");
  EXPECT_EQ(files.source_of("d"), "");
  EXPECT_THAT(files.describe(), ElementsAre("id1/pak1.pak (1 files)", "id1/pak0.pak (2 files)", "id1"));
}

TEST(FileSystem, PakNumbersHaveNoGaps) {
  const TestDirectory base;
  base.put("id1/pak0.pak", make_pak({{"a", "pak0"}}));
  base.put("id1/pak2.pak", make_pak({{"a", "pak2"}}));
  EXPECT_EQ(text(open(options_for(base)), "a"), "pak0");
}

TEST(FileSystem, MoreThanTenPaksGoByNumber) {
  const TestDirectory base;
  for (int i = 0; i < 12; ++i)
    base.put("id1/pak" + std::to_string(i) + ".pak", make_pak({{"a", "pak" + std::to_string(i)}}));
  EXPECT_EQ(text(open(options_for(base)), "a"), "pak11");
}

TEST(FileSystem, LaterGamesWinEvenWithLooseFilesOverPaks) {
  const TestDirectory base;
  base.put("id1/pak0.pak", make_pak({{"a", "id1 pak"}, {"b", "id1 pak"}, {"c", "id1 pak"}}));
  base.put("hipnotic/a", "hipnotic loose");
  base.put("hipnotic/b", "hipnotic loose");
  base.put("ad/a", "ad loose");
  const FileSystem files = open(options_for(base, {"hipnotic", "ad"}));
  EXPECT_EQ(text(files, "a"), "ad loose");
  EXPECT_EQ(text(files, "b"), "hipnotic loose");
  EXPECT_EQ(text(files, "c"), "id1 pak");
  EXPECT_EQ(files.game_index_of("a"), 2);
  EXPECT_EQ(files.game_index_of("b"), 1);
  EXPECT_EQ(files.game_index_of("c"), 0);
  EXPECT_EQ(files.game_index_of("d"), -1);
  EXPECT_EQ(files.game(), "ad");
}

TEST(FileSystem, UserDirectoryWinsOverItsGamedirOnly) {
  const TestDirectory base, user;
  base.put("id1/pak0.pak", make_pak({{"a", "id1 pak"}, {"b", "id1 pak"}}));
  base.put("id1/pak1.pak", make_pak({{"c", "id1 pak1"}}));
  base.put("ad/b", "ad loose");
  user.put("id1/a", "user id1 loose");
  user.put("id1/b", "user id1 loose");
  user.put("id1/c", "user id1 loose");
  user.put("id1/pak0.pak", make_pak({{"c", "user id1 pak0"}}));
  FsOptions options = options_for(base, {"ad"});
  options.user_dir = user.path();
  const FileSystem files = open(options);
  EXPECT_EQ(text(files, "a"), "user id1 loose");
  EXPECT_EQ(text(files, "b"), "ad loose");
  EXPECT_EQ(text(files, "c"), "user id1 pak0");
  EXPECT_EQ(files.source_of("c"), "user/id1/pak0.pak");
}

TEST(FileSystem, WritesBelowTheUserDirectoryAndFindsThemAgain) {
  const TestDirectory base, user;
  base.put("id1/config.cfg", "old");
  base.put("ad/x", "");
  FsOptions options = options_for(base, {"ad"});
  options.user_dir = user.path() / "not" / "yet" / "there";
  const FileSystem files = open(options);
  EXPECT_FALSE(std::filesystem::exists(*options.user_dir)) << "only writing may make it";
  EXPECT_EQ(text(files, "config.cfg"), "old");
  const std::string fresh = "new";
  ASSERT_TRUE(files.write("config.cfg", Bytes(fresh.begin(), fresh.end())));
  EXPECT_EQ(*files.write_path("config.cfg"), *options.user_dir / "ad" / "config.cfg");
  EXPECT_EQ(text(files, "config.cfg"), "new");
  EXPECT_FALSE(files.write_path("../x"));
}

TEST(FileSystem, ThePlayersOwnFolderIsAGameOnlyWithTheGamesCode) {
  const TestDirectory base, user;
  user.put("id1/config.cfg", "bind x y");
  FsOptions options = options_for(base);
  options.user_dir = user.path();
  const auto none = FileSystem::open(options);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("-basedir"));
  user.put("id1/pak0.pak", make_pak({{"progs.dat", "code"}}));
  EXPECT_EQ(text(open(options), "progs.dat"), "code");
}

TEST(FileSystem, OwnFilesAreLooseOnesOfTheLastGame) {
  const TestDirectory base, user;
  base.put("id1/old.sav", "id1");
  base.put("ad/base.sav", "ad");
  base.put("ad/both.sav", "ad");
  base.put("ad/pak0.pak", make_pak({{"packed.sav", "pak"}}));
  user.put("ad/both.sav", "user");
  user.put("id1/user.sav", "user id1");
  FsOptions options = options_for(base, {"ad"});
  options.user_dir = user.path();
  const FileSystem files = open(options);
  const auto own = [&](std::string_view name) {
    const auto data = files.read_own(name);
    return data ? as_text(*data) : "(none)";
  };
  EXPECT_EQ(own("both.sav"), "user");
  EXPECT_EQ(own("base.sav"), "ad") << "what QuakeSpasm has saved there";
  for (const char* name : {"old.sav", "user.sav", "packed.sav", "../id1/old.sav", ""})
    EXPECT_EQ(own(name), "(none)") << name;
}

TEST(FileSystem, WritesBelowTheBaseWhereThereIsNoUserDirectory) {
  const TestDirectory base;
  base.put("id1/x", "");
  EXPECT_EQ(*open(options_for(base)).write_path("s0.sav"), base.path() / "id1" / "s0.sav");
}

#ifdef __unix__
TEST(FileSystem, WithoutAHomeNothingIsWrittenIntoTheGamesData) {
  const TestDirectory base;
  base.put("id1/x", "");
  std::filesystem::permissions(base.path(), std::filesystem::perms::all);
  std::filesystem::permissions(base.path() / "id1", std::filesystem::perms::all);
  FsOptions options = options_for(base);
  options.user_dir.reset();
  const NoHome none;
  const PermissionsCount nobody;  // who has no home either
  if (!default_user_dir().empty()) GTEST_SKIP() << "this user has a home, and cannot become another";
  const LogLines log;
  const FileSystem files = open(options);
  EXPECT_THAT(log.lines, ElementsAre(HasSubstr("-userdir DIR")));
  const Status written = files.write("s0.sav", Bytes{1});
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("s0.sav: cannot be written: there is no home folder; -userdir DIR"));
  EXPECT_FALSE(std::filesystem::exists(base.path() / "id1" / "s0.sav"));
  options.user_dir = "";  // -nohome
  EXPECT_TRUE(open(options).write("s0.sav", Bytes{1}));
}
#endif

TEST(FileSystem, AFolderThatCannotBeMadeIsNamedWithTheWayOut) {
  const TestDirectory base;
  base.put("id1/x", "");
  base.put("file", "");
  FsOptions options = options_for(base);
  options.user_dir = base.path() / "file" / "home";
  const Status written = open(options).write("s0.sav", Bytes{1});
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("Not a directory; -userdir DIR names another folder"));
}

TEST(FileSystem, NamesOutsideAreNeverFound) {
  const TestDirectory base;
  base.put("secret", "s");
  base.put("id1/maps/a.bsp", "a");
  base.put("id1/pak0.pak", make_pak({{"../secret", "p"}, {"/etc/x", "p"}}));
  const FileSystem files = open(options_for(base));
  for (const char* name : {"../secret", "maps/../../secret", "/etc/x", "", ".", "maps"})
    EXPECT_FALSE(files.exists(name)) << name;
  EXPECT_FALSE(files.exists((base.path() / "secret").string()));
  EXPECT_EQ(text(files, "maps\\a.bsp"), "a");
  const auto missing = files.load("maps/none.bsp");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("maps/none.bsp: no such file"));
}

TEST(FileSystem, CaseIsAFallbackWithOneNote) {
  const TestDirectory base;
  base.put("id1/Maps/START.bsp", "loose");
  base.put("id1/pak0.pak", make_pak({{"Progs/Ogre.mdl", "pak"}, {"gfx/A.lmp", "upper pak"}}));
  base.put("id1/gfx/a.lmp", "exact loose");
  const FileSystem files = open(options_for(base));
  LogLines log;
  EXPECT_EQ(text(files, "maps/start.bsp"), "loose");
  EXPECT_EQ(text(files, "maps/start.bsp"), "loose");
  EXPECT_EQ(text(files, "progs/ogre.mdl"), "pak");
  EXPECT_THAT(log.lines, SizeIs(2));
  EXPECT_THAT(log.lines.front(), HasSubstr("maps/start.bsp: found only as START.bsp in id1"));
  EXPECT_EQ(text(files, "gfx/a.lmp"), "exact loose") << "the exact name wins, also over an earlier place";
  EXPECT_THAT(log.lines, SizeIs(2));
}

TEST(FileSystem, CaseFallbackSeesNewFiles) {
  const TestDirectory base;
  base.put("id1/x", "");
  const FileSystem files = open(options_for(base));
  EXPECT_FALSE(files.exists("s0.sav"));
  base.put("id1/S0.SAV", "saved");
  std::filesystem::last_write_time(base.path() / "id1", std::filesystem::file_time_type::clock::now() +
                                                            std::chrono::seconds(5));  // clocks may be coarse
  EXPECT_EQ(text(files, "s0.sav"), "saved");
}

TEST(FileSystem, UpperCasePaksAsOnTheCd) {
  const TestDirectory base;
  base.put("ID1/PAK0.PAK", make_pak({{"a", "pak"}}));
  EXPECT_EQ(text(open(options_for(base)), "a"), "pak");
}

TEST(FileSystem, ListsEachFileOnceAsItWouldBeRead) {
  const TestDirectory base;
  base.put("id1/maps/loose.bsp", "12345");
  base.put("id1/maps/both.bsp", "loose");
  base.put("id1/maps/notes.txt", "");
  base.put("id1/textures/deep/x.BSP", "");
  base.put("id1/pak0.pak", make_pak({{"maps/both.bsp", "in pak"}, {"maps/b_shell0.bsp", ""}, {"sound/x.wav", ""}}));
  const FileSystem files = open(options_for(base));
  std::vector<std::string> names, sources;
  for (const FoundFile& file : files.find("maps/", ".bsp")) {
    names.push_back(file.name);
    sources.push_back(file.source);
  }
  EXPECT_THAT(names, ElementsAre("maps/b_shell0.bsp", "maps/both.bsp", "maps/loose.bsp"));
  EXPECT_THAT(sources, ElementsAre("id1/pak0.pak", "id1/pak0.pak", "id1"));
  EXPECT_EQ(files.find("maps/loose", "")[0].size, 5u);
  EXPECT_THAT(files.find("", ".bsp"), SizeIs(4));
  EXPECT_THAT(files.find("MAPS/", ".BSP"), SizeIs(3));
}

TEST(FileSystem, AListingEndsWhereLinksLoop) {
  const TestDirectory base;
  base.put("id1/maps/a.bsp", "");
  std::filesystem::create_directory_symlink("..", base.path() / "id1" / "maps" / "up");
  EXPECT_GE(open(options_for(base)).find("", ".bsp").size(), 1u);
}

TEST(FileSystem, WhatIsMissingOrMalformedIsSaid) {
  const TestDirectory base;
  const auto failure = [](const FsOptions& options) {
    const auto files = FileSystem::open(options);
    return files ? std::string("no failure") : files.error().message;
  };
  EXPECT_THAT(failure(options_for(base)), HasSubstr("there is no directory id1"));
  base.put("id1/x", "");
  EXPECT_THAT(failure(options_for(base, {"ad"})), HasSubstr("there is no directory ad"));
  EXPECT_THAT(failure(options_for(base, {".."})), HasSubstr("not a path"));
  base.put("id1/pak0.pak", "PACX");
  EXPECT_THAT(failure(options_for(base)), HasSubstr("id1/pak0.pak: offset"));
}

TEST(FileSystem, LoaderFollowsAReopenedFileSystem) {
  const TestDirectory base;
  base.put("id1/a", "id1");
  base.put("ad/a", "ad");
  FileSystem files = open(options_for(base));
  const auto loader = files.loader();
  EXPECT_EQ(as_text(*loader("a")), "id1");
  files = open(options_for(base, {"ad"}));
  EXPECT_EQ(as_text(*loader("a")), "ad");
  EXPECT_EQ(loader("b"), std::nullopt);
}

TEST(FileSystem, RealData) {
  if (const std::string lacks = librequake_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  FsOptions options;
  options.base_dir = librequake_folder();
  options.user_dir.emplace();
  const FileSystem files = open(options);
  for (const FoundFile& file : files.find("", "")) {
    const auto data = files.load(file.name);
    ASSERT_TRUE(data) << data.error().message;
    EXPECT_EQ(data->size(), file.size) << file.name;
  }
  EXPECT_EQ(files.load("gfx/palette.lmp")->size(), 768u);
  EXPECT_GE(files.find("maps/", ".bsp").size(), 1u);
}

}  // namespace
}  // namespace fb::fs
