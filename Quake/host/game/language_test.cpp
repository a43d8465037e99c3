#include "host/game/language.h"

#include <gmock/gmock.h>

#include "fs/test_log.h"
#include "fs/test_paks.h"
#include "fs/test_zips.h"
#include "base/test_directory.h"

namespace fb::host {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LanguageTest : public ::testing::Test {
 protected:
  void SetUp() override { base.put("id1/x", "x"); }
  void start(std::vector<std::string> games = {}) {
    fs::FsOptions options;
    options.base_dir = base.path();
    options.user_dir = user.path();
    options.games = std::move(games);
    auto opened = fs::FileSystem::open(options);
    ASSERT_TRUE(opened) << opened.error().message;
    files.emplace(std::move(*opened));
    register_language(console, *files);
  }
  std::string text(std::string_view key) const { return std::string(console.localization().text(key)); }

  const TestDirectory base, user;
  std::optional<fs::FileSystem> files;  // outlives the console
  con::Console console;
};

TEST_F(LanguageTest, WithoutFilesNothingIsSaid) {
  const fs::LogLines log;
  start();
  EXPECT_THAT(log.lines, IsEmpty());
  EXPECT_EQ(text("$a"), "$a");
}

TEST_F(LanguageTest, EveryPlaceAndTheirOrder) {
  const std::string name = "localization/loc_english.txt";
  base.put("QuakeEX.kpf", fs::make_zip({{name, "a = \"kpf\"\nb = \"kpf\"\nc = \"kpf\"\nd = \"kpf\"\n"}}));
  base.put(name, "a = \"beside\"\nb = \"beside\"\nc = \"beside\"\n");
  base.put("id1/pak0.pak", fs::make_pak({{name, "a = \"pak\"\nb = \"pak\"\n"}}));
  base.put("mod/" + name, "a = \"mod\"\n");
  const fs::LogLines log;
  start({"mod"});
  EXPECT_THAT(log.lines, IsEmpty());
  EXPECT_EQ(text("$a") + text("$b") + text("$c") + text("$d"), "modpakbesidekpf");
}

TEST_F(LanguageTest, ThePlayersFolderHasAnArchive) {
  user.put("QuakeEX.kpf",
           fs::make_zip({{"localization/loc_english.txt", "a = \"kpf\"\n", fs::deflated("a = \"kpf\"\n"), 8}}));
  start();
  EXPECT_EQ(text("$a"), "kpf");
}

TEST_F(LanguageTest, AnotherLanguageFallsBackToEnglish) {
  base.put("id1/localization/loc_english.txt", "a = \"English\"\nb = \"English\"\n");
  base.put("id1/localization/loc_german.txt", "a = \"Deutsch\"\n");
  start();
  EXPECT_EQ(text("$a") + text("$b"), "EnglishEnglish");
  console.execute("language German");
  EXPECT_EQ(text("$a") + text("$b"), "DeutschEnglish");
  const fs::LogLines log;
  console.execute("language klingon");
  EXPECT_EQ(text("$a"), "English");
  console.execute("language ../../x");
  EXPECT_EQ(text("$a"), "English");
  EXPECT_THAT(log.lines,
              ElementsAre(HasSubstr("language klingon: there is no localization/loc_klingon.txt; texts are english"),
                          HasSubstr("language \"../../x\": a language is one word; texts are english")));
}

TEST_F(LanguageTest, TheSystemsLanguage) {
  base.put("id1/localization/loc_english.txt", "a = \"English\"\n");
  base.put("id1/localization/loc_german.txt", "a = \"Deutsch\"\n");
  start();
  ASSERT_EQ(setenv("LC_ALL", "de_AT.UTF-8", 1), 0);
  console.execute("language auto");
  unsetenv("LC_ALL");
  EXPECT_EQ(text("$a"), "Deutsch");
}

TEST_F(LanguageTest, HostileFilesAreToldOf) {
  base.put("QuakeEX.kpf", "no archive");
  base.put("localization/loc_english.txt", std::string(con::Localization::kMostFileBytes + 1, 'x'));
  base.put("id1/localization/loc_english.txt", "a = \"fine\"\n");
  const fs::LogLines log;
  start();
  EXPECT_EQ(text("$a"), "fine");
  EXPECT_THAT(log.lines, ElementsAre(HasSubstr("localization/loc_english.txt: 8388609 bytes of texts"),
                                     HasSubstr("QuakeEX.kpf: not a zip archive")));
}

}  // namespace
}  // namespace fb::host
