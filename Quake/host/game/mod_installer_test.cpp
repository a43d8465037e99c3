#include "host/game/mod_installer.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "base/log.h"
#include "base/test_directory.h"
#include "fs/file.h"
#include "fs/test_zips.h"
#include "host/game/mod_list.h"

namespace fb::host {
namespace {

using fs::make_zip;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ModInstallerTest : public testing::Test {
 protected:
  ModInstallerTest() {
    directory.put("base/id1/progs.dat", "code");
    directory.put("base/rogue/pak0.pak", std::string("PACK\x0c\0\0\0\0\0\0\0", 12));
    open({});
    listener = add_log_listener([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  }
  ~ModInstallerTest() override {
    installer.reset();
    remove_log_listener(listener);
  }
  void open(std::vector<std::string> games) {
    installer.reset();
    fs::FsOptions options;
    options.base_dir = directory.file("base");
    options.base_dir_named = true;
    options.games = std::move(games);
    options.user_dir = directory.file("user");
    auto opened = fs::FileSystem::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files.emplace(*std::move(opened));
    console.emplace();
    installer.emplace(*console, *files);
  }
  // What is logged until nothing is installed any more.
  std::string run(const std::string& line) {
    log.clear();
    console->execute(line);
    while (installer->busy()) {
      installer->poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return log;
  }
  std::string text(const std::string& name) const {
    const auto data = fs::read_whole_file(directory.path() / name);
    return data ? std::string(data->text()) : "no file";
  }
  std::vector<std::string> mods() const {
    std::vector<std::string> names;
    for (const auto& mod : list_mods(*files)) names.push_back(mod.directory);
    return names;
  }

  TestDirectory directory;
  std::string log;
  int listener = 0;
  std::optional<fs::FileSystem> files;
  std::optional<con::Console> console;
  std::optional<ModInstaller> installer;
};

TEST_F(ModInstallerTest, AModIsInstalledByTheNameOfItsArchive) {
  directory.put("user/archives/Ad 1.8.zip", make_zip({{"ad/progs.dat", "code"}, {"ad/maps/a.bsp", "map"}}));
  const std::uint64_t before = installer->revision();
  EXPECT_EQ(run("installmod \"Ad 1.8\""), "Installing ad: 2 files, 7 bytes.\nad is installed: \"game ad\" plays it.\n");
  EXPECT_NE(installer->revision(), before);
  EXPECT_EQ(text("user/ad/maps/a.bsp"), "map");
  EXPECT_THAT(mods(), ElementsAre("id1", "ad", "rogue"));
  EXPECT_EQ(installer->state().installed, "ad");
  EXPECT_EQ(installer->state().failure, "");
  EXPECT_FALSE(console->failed());
}

TEST_F(ModInstallerTest, OrByItsPath) {
  directory.put("down/ad.zip", make_zip({{"progs.dat", "code"}}));
  run("installmod \"" + directory.file("down/ad.zip") + "\"");
  EXPECT_EQ(text("user/ad/progs.dat"), "code");
}

TEST_F(ModInstallerTest, WhatFailsSaysWhyAndTheGameGoesOn) {
  directory.put("user/archives/bad.zip", make_zip({{"progs.dat", "code"}, {"../x", "x"}}));
  directory.put("user/archives/torn.zip", make_zip({{"progs.dat", "abc", "abd"}}));
  EXPECT_EQ(run("installmod bad"), "installmod: bad.zip: \"../x\" in it: its name leads outside of the mod's folder\n");
  EXPECT_THAT(installer->state().failure, HasSubstr("leads outside"));
  EXPECT_TRUE(console->failed());
  EXPECT_THAT(run("installmod torn"), HasSubstr("installmod: torn.zip: progs.dat in it is damaged: "));
  EXPECT_THAT(installer->state().failure, HasSubstr("damaged"));
  EXPECT_THAT(run("installmod none"), HasSubstr("installmod: none.zip: "));
  EXPECT_THAT(run("installmod a b c"), HasSubstr("installmod [archive [replace]]"));
  EXPECT_THAT(run("installmod a b"), HasSubstr("installmod [archive [replace]]"));
  EXPECT_THAT(mods(), ElementsAre("id1", "rogue"));
}

TEST_F(ModInstallerTest, AModThatIsThereIsReplacedWhenAskedTo) {
  directory.put("user/archives/ad.zip", make_zip({{"progs.dat", "new"}}));
  directory.put("user/ad/progs.dat", "old");
  directory.put("user/ad/s0.sav", "saved");
  EXPECT_THAT(run("installmod ad"), HasSubstr("(installmod NAME replace; saves and settings stay)"));
  EXPECT_EQ(text("user/ad/progs.dat"), "old");
  run("installmod ad replace");
  EXPECT_EQ(text("user/ad/progs.dat"), "new");
  EXPECT_EQ(text("user/ad/s0.sav"), "saved");
}

// Its files are open, and the game saves into it.
TEST_F(ModInstallerTest, TheModThatIsPlayedStays) {
  directory.put("user/archives/ad.zip", make_zip({{"progs.dat", "new"}}));
  directory.put("user/ad/progs.dat", "old");
  open({"ad"});
  EXPECT_THAT(run("installmod ad replace"), HasSubstr("ad is played"));
  EXPECT_EQ(text("user/ad/progs.dat"), "old");
}

TEST_F(ModInstallerTest, ItCanBeGivenUpAndEndsWithTheProgram) {
  directory.put("user/archives/ad.zip", make_zip({{"progs.dat", std::string(64u << 20u, 'x')}}));
  log.clear();
  console->execute("installmod ad; installmod ad; installmod cancel");
  EXPECT_THAT(log, HasSubstr("installmod: ad.zip is being installed"));
  EXPECT_EQ(installer->state().going_on, "ad");
  EXPECT_THAT(mods(), ElementsAre("id1", "rogue")) << "what is half there is not listed";
  EXPECT_THAT(run(""), HasSubstr("given up"));
  console->execute("installmod ad");
  installer.reset();
  EXPECT_THAT(log, HasSubstr("ad.zip: it is not installed, since the program ends"));
  EXPECT_THAT(mods(), ElementsAre("id1", "rogue"));
}

TEST_F(ModInstallerTest, WhatIsHalfThereOrWaitsIsNoMod) {
  directory.put("user/.fullbright-1-0123456789abcdef.new/pak0.pak", "half");
  directory.put("user/archives/x.pk3", "x");
  EXPECT_THAT(mods(), ElementsAre("id1", "rogue"));
}

TEST_F(ModInstallerTest, ArchivesAreListedForTheMenu) {
  EXPECT_THAT(installer->archives(), IsEmpty());
  directory.put("user/archives/b.zip", make_zip({{"quoth/progs.dat", "code"}, {"quoth/x", std::string(3000, 'x')}}));
  directory.put("user/archives/a.ZIP", make_zip({{"rogue/progs.dat", "code"}}));
  directory.put("user/archives/c.zip", "no archive");
  directory.put("user/archives/quo\"te.zip", make_zip({{"progs.dat", "code"}}));
  directory.put("user/archives/readme.txt", "x");
  directory.put("user/quoth/progs.dat", "old");
  auto list = installer->archives();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].name, "a.ZIP");
  EXPECT_THAT(list[0].failure, HasSubstr("base/rogue is there already"));
  EXPECT_EQ(list[1].mod, "quoth");
  EXPECT_EQ(list[1].facts, "2 files, 2.9 KiB unpacked");
  EXPECT_EQ(list[1].failure, "");
  EXPECT_TRUE(list[1].replaces);
  EXPECT_THAT(list[2].failure, HasSubstr("c.zip: not a zip archive"));
  directory.put("user/archives/c.zip", make_zip({{"progs.dat", "code"}}));
  list = installer->archives();
  EXPECT_EQ(list[2].failure, "") << "it is another file now";
  EXPECT_EQ(list[2].mod, "c");
  EXPECT_FALSE(list[2].replaces);
  EXPECT_THAT(run("installmod"), HasSubstr("   b.zip: 2 files, 2.9 KiB unpacked\n"));
  std::vector<std::string> completed;
  for (const auto& candidate : console->complete("installmod c").candidates) completed.push_back(candidate.text);
  EXPECT_THAT(completed, ElementsAre("c.zip"));
}

}  // namespace
}  // namespace fb::host
