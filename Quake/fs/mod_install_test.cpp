#include "fs/mod_install.h"

#include <gmock/gmock.h>
#ifdef __unix__
#include <sys/resource.h>
#endif

#include <algorithm>

#include "base/stop.h"
#include "fs/file.h"
#include "fs/held_file.h"
#include "fs/temporary_file.h"
#include "fs/test_files.h"
#include "fs/test_zips.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const InstallProgress kOn = [](std::uint64_t) { return true; };

class ModInstall : public testing::Test {
 protected:
  static std::unique_ptr<ModArchive> archive_of(const std::vector<ZippedFile>& files) {
    auto archive = ModArchive::open(FileData(make_zip(files)), "ad.zip");
    EXPECT_TRUE(archive) << archive.error().message;
    return *std::move(archive);
  }
  // The mod's folder, or why there is none.
  std::string install(const std::vector<ZippedFile>& files, Existing existing = Existing::kRefuse,
                      const InstallProgress& progress = kOn) const {
    const auto folder =
        install_mod(*archive_of(files), {directory.path() / "user", {directory.path() / "base"}}, existing, progress);
    return folder ? folder->lexically_relative(directory.path()).generic_string() : folder.error().message;
  }
  // Every file below the directory, with its text.
  std::vector<std::string> all() const {
    std::vector<std::string> found;
    for (const auto& entry : stdfs::recursive_directory_iterator(directory.path())) {
      const std::string name = entry.path().lexically_relative(directory.path()).generic_string();
      if (entry.is_symlink())
        found.push_back(name + " -> " + stdfs::read_symlink(entry.path()).generic_string());
      else if (entry.is_regular_file())
        found.push_back(name + ": " + text(name));
      else if (stdfs::is_empty(entry.path()))
        found.push_back(name + "/");
    }
    std::ranges::sort(found);
    return found;
  }
  std::string text(const std::string& name) const {
    const auto data = read_whole_file(directory.path() / name);
    return data ? std::string(data->text()) : data.error().message;
  }

  const TestDirectory directory;
};

TEST_F(ModInstall, MakesTheFolderAndTellsHowFarItIs) {
  const std::string large(3u << 20u, 'x');
  std::vector<std::uint64_t> told;
  EXPECT_EQ(install({{"progs.dat", "code"}, {"maps/a.bsp", "map", deflated("map"), 8}, {"pak0.pak", large}, {"e", ""}},
                    Existing::kRefuse,
                    [&](std::uint64_t bytes) {
                      told.push_back(bytes);
                      return true;
                    }),
            "user/ad");
  EXPECT_EQ(text("user/ad/progs.dat"), "code");
  EXPECT_EQ(text("user/ad/maps/a.bsp"), "map");
  EXPECT_EQ(text("user/ad/pak0.pak"), large);
  EXPECT_EQ(text("user/ad/e"), "");
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_GE(told.size(), 8u);
  EXPECT_EQ(told.back(), large.size() + 7);
  const auto mode = stdfs::status(directory.path() / "user/ad/progs.dat").permissions();
  EXPECT_EQ(mode & stdfs::perms::owner_exec, stdfs::perms::none);
}

TEST_F(ModInstall, AMomentBeforeTheEndThereIsNoFolderOfItsName) {
  bool seen = false;
  install({{"progs.dat", "code"}, {"last", "x"}}, Existing::kRefuse, [&](std::uint64_t) {
    seen = seen || stdfs::exists(directory.path() / "user/ad");
    return true;
  });
  EXPECT_FALSE(seen);
  EXPECT_TRUE(stdfs::exists(directory.path() / "user/ad"));
}

TEST_F(ModInstall, WhatFailsLeavesNothing) {
  EXPECT_THAT(install({{"progs.dat", "code"}, {"maps/a.bsp", "abc", "abd"}}),
              StartsWith("ad.zip: maps/a.bsp in it is damaged: "));
  EXPECT_THAT(all(), ElementsAre("user/"));
  int calls = 0;
  EXPECT_EQ(install({{"progs.dat", "code"}, {"b", "x"}, {"c", "x"}}, Existing::kRefuse,
                    [&](std::uint64_t) { return ++calls < 4; }),
            "ad.zip: it was not installed: it was given up");
  EXPECT_EQ(calls, 4) << "nothing is unpacked any more";
  EXPECT_THAT(all(), ElementsAre("user/"));
}

#ifdef __unix__
TEST_F(ModInstall, AFullDiskLeavesNothing) {
  directory.put("user/ad/s0.sav", "saved");
  survive_failed_writes();
  rlimit former{};
  ::getrlimit(RLIMIT_FSIZE, &former);
  const rlimit small{100000, former.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string failure = install({{"progs.dat", "code"}, {"pak0.pak", std::string(200000, 'x')}});
  ::setrlimit(RLIMIT_FSIZE, &former);
  EXPECT_THAT(failure, StartsWith("ad/pak0.pak: cannot be written: "));
  EXPECT_THAT(all(), ElementsAre("user/ad/s0.sav: saved"));
}
#endif

TEST_F(ModInstall, WhatAKilledProgramHasLeftIsRemovedAndALivingOnesStays) {
  directory.put("user/.fullbright-1-0123456789abcdef.new/pak0.pak", "half");
  const auto living = HeldFile::take_folder(directory.path() / "user/.fullbright-2-0123456789abcdef.new");
  ASSERT_TRUE(living);
  EXPECT_EQ(install({{"progs.dat", "code"}}), "user/ad");
  EXPECT_THAT(all(), ElementsAre("user/.fullbright-2-0123456789abcdef.new/", "user/ad/progs.dat: code"));
}

TEST_F(ModInstall, AModThatIsThereIsRefused) {
  directory.put("user/ad/progs.dat", "old");
  EXPECT_THAT(install({{"progs.dat", "new"}}), HasSubstr("user/ad is there already"));
  EXPECT_THAT(all(), ElementsAre("user/ad/progs.dat: old"));
}

TEST_F(ModInstall, AModBesideTheGamesDataIsNotDoubled) {
  directory.put("base/AD/pak0.pak", "old");
  for (const Existing existing : {Existing::kRefuse, Existing::kReplace})
    EXPECT_THAT(install({{"progs.dat", "new"}}, existing),
                HasSubstr("base/AD is there already, where the game's data"));
  EXPECT_THAT(all(), ElementsAre("base/AD/pak0.pak: old", "user/"));
}

TEST_F(ModInstall, AReplacedModKeepsWhatThePlayerHas) {
  directory.put("user/ad/progs.dat", "old");
  directory.put("user/ad/pak0.pak", "old");
  directory.put("user/ad/pak1.pak", "old");
  directory.put("user/ad/maps/mine.bsp", "mine");
  directory.put("user/ad/maps/a.bsp", "old");
  directory.put("user/ad/s0.sav", "saved");
  directory.put("user/ad/s0.png", "picture");
  directory.put("user/ad/autosave/start.sav", "saved");
  directory.put("user/ad/config.cfg", "mine");
  directory.put("user/ad/data/list.txt", "mine");
  directory.put("user/ad/quake.rc", "old");
  stdfs::create_symlink("config.cfg", directory.path() / "user/ad/autoexec.cfg");
  EXPECT_EQ(install({{"pak0.pak", "new"},
                     {"maps/a.bsp", "new"},
                     {"config.cfg", "new"},
                     {"s0.sav", "new"},
                     {"data/list.txt", "new"},
                     {"quake.rc", "new"}},
                    Existing::kReplace),
            "user/ad");
  EXPECT_THAT(all(), ElementsAre("user/ad/autoexec.cfg -> config.cfg", "user/ad/autosave/start.sav: saved",
                                 "user/ad/config.cfg: mine", "user/ad/data/list.txt: mine", "user/ad/maps/a.bsp: new",
                                 "user/ad/maps/mine.bsp: mine", "user/ad/pak0.pak: new", "user/ad/quake.rc: new",
                                 "user/ad/s0.png: picture", "user/ad/s0.sav: saved"));
}

TEST_F(ModInstall, AFailedReplacementLeavesTheFormerMod) {
  directory.put("user/ad/progs.dat", "old");
  directory.put("user/ad/s0.sav", "saved");
  EXPECT_THAT(install({{"progs.dat", "new"}, {"x", "abc", "abd"}}, Existing::kReplace), HasSubstr("damaged"));
  EXPECT_THAT(all(), ElementsAre("user/ad/progs.dat: old", "user/ad/s0.sav: saved"));
}

// A folder with no game in it is no mod: all of it stays.
TEST_F(ModInstall, AFolderOfSavesAloneGetsTheMod) {
  directory.put("user/AD/s0.sav", "saved");
  directory.put("user/AD/notes.dat", "mine");
  EXPECT_EQ(install({{"progs.dat", "new"}}), "user/AD");
  EXPECT_THAT(all(), ElementsAre("user/AD/notes.dat: mine", "user/AD/progs.dat: new", "user/AD/s0.sav: saved"));
}

TEST_F(ModInstall, LinksAndFilesOfItsNameAreRefused) {
  directory.put("elsewhere/progs.dat", "mine");
  stdfs::create_directories(directory.path() / "user");
  stdfs::create_symlink("../elsewhere", directory.path() / "user/ad");
  EXPECT_THAT(install({{"progs.dat", "new"}}, Existing::kReplace), HasSubstr("user/ad is a link"));
  stdfs::remove(directory.path() / "user/ad");
  directory.put("user/ad", "a file");
  EXPECT_THAT(install({{"progs.dat", "new"}}, Existing::kReplace), HasSubstr("user/ad is there and is no folder"));
  EXPECT_THAT(all(), ElementsAre("elsewhere/progs.dat: mine", "user/ad: a file"));
}

TEST_F(ModInstall, MoreThanTheDiskHasIsRefusedAtOnce) {
  ModPlan plan;
  plan.folder = "ad";
  plan.bytes = ~std::uint64_t{0} - 1;
  const Status status = may_install(plan, {directory.path(), {}}, Existing::kRefuse);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("the mod needs "));
}

}  // namespace
}  // namespace fb::fs
