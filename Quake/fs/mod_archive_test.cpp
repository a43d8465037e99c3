#include "fs/mod_archive.h"

#include <gmock/gmock.h>

#include "fs/test_files.h"
#include "fs/test_zips.h"

namespace fb::fs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

Result<std::unique_ptr<ModArchive>> archive_of(const std::vector<ZippedFile>& files, const std::string& name = "ad.zip",
                                               const ModLimits& limits = {}) {
  return ModArchive::open(FileData(make_zip(files)), name, limits);
}
std::string planned(const std::vector<ZippedFile>& files, const std::string& name = "ad.zip") {
  const auto archive = archive_of(files, name);
  if (!archive) return archive.error().message;
  std::string text = (*archive)->plan().folder + ":";
  for (const PlannedFile& file : (*archive)->plan().files) text += " " + file.name;
  return text;
}
// Why an archive that has this file, too, is refused.
std::string refused(const ZippedFile& bad) {
  const std::string text = planned({{"progs.dat", "code"}, bad, {"maps/a.bsp", "map"}});
  EXPECT_THAT(text, StartsWith("ad.zip: ")) << bad.name;
  return text.substr(std::min<std::size_t>(text.size(), 8));
}

TEST(ModArchive, TheModLiesAtTheTopOrInAFolder) {
  EXPECT_EQ(planned({{"progs.dat", "code"}, {"maps/", ""}, {"maps/a.bsp", "map"}}), "ad: progs.dat maps/a.bsp");
  EXPECT_EQ(planned({{"Quoth/pak0.pak", "pak"}, {"Quoth/doc/a.txt", "x"}}), "quoth: pak0.pak doc/a.txt");
  EXPECT_EQ(planned({{"v1/copper/maps/a.bsp", "map"}, {"v1/copper/x.cfg", "x"}}), "copper: maps/a.bsp x.cfg");
  EXPECT_EQ(planned({{"readme.txt", "x"}, {"docs/a.txt", "x"}, {"mg1/x.pk3", "pk3"}}), "mg1: x.pk3");
}

TEST(ModArchive, NamesThatAGameIsKnownByAreInLowerCase) {
  EXPECT_EQ(planned({{"AD/PAK0.PAK", "x"}, {"AD/Progs.DAT", "x"}, {"AD/Maps/A.bsp", "x"}, {"AD/Sound/A.wav", "x"}}),
            "ad: pak0.pak progs.dat maps/A.bsp Sound/A.wav");
}

TEST(ModArchive, TheFolderIsNamedByTheArchiveWhereThereIsNone) {
  const auto named = [](const std::string& archive) { return planned({{"progs.dat", "x"}}, archive); };
  EXPECT_EQ(named("My Mod (1).v2.ZIP"), "my_mod__1_.v2: progs.dat");
  EXPECT_EQ(named("-game.zip"), "game: progs.dat");
  EXPECT_EQ(named("a..b.zip"), "a.b: progs.dat");
  for (const char* none : {"....zip", "con.zip", ".zip"})
    EXPECT_THAT(named(none), HasSubstr("gives no name for the mod's folder")) << none;
  EXPECT_THAT(planned({{"id1/maps/a.bsp", "x"}}), HasSubstr("its folder is id1, which is no mod's"));
  EXPECT_THAT(named("archives.zip"), HasSubstr("its folder is archives, which is no mod's"));
}

TEST(ModArchive, WhatIsNoModIsToldApart) {
  EXPECT_EQ(planned({{"jam.bsp", "map"}, {"jam.txt", "x"}}),
            "ad.zip: it holds maps alone: unpack them into the folder id1/maps");
  EXPECT_THAT(planned({{"a/b/c/picture.png", "x"}}), HasSubstr("there is no mod in it"));
  EXPECT_THAT(planned({}), StartsWith("ad.zip: "));
  EXPECT_EQ(planned({{"ad/progs.dat", "x"}, {"quoth/progs.dat", "x"}}),
            "ad.zip: it holds several mods, ad/ and quoth/");
}

TEST(ModArchive, LeavesOutWhatIsNotTheMods) {
  const auto archive = archive_of({{"ad/progs.dat", "x"},
                                   {"read me.txt", "x"},
                                   {"ad/lisez-moi \xe9.txt", "x"},
                                   {"__MACOSX/ad/progs.dat", "x"},
                                   {"ad/.DS_Store", "x"},
                                   {"ad/gfx/Thumbs.db", "x"}});
  ASSERT_TRUE(archive) << archive.error().message;
  ASSERT_EQ((*archive)->plan().files.size(), 1u);
  EXPECT_EQ((*archive)->plan().files[0].name, "progs.dat");
  EXPECT_EQ((*archive)->plan().bytes, 1u);
  EXPECT_EQ((*archive)->plan().left_out, "ad.zip: 2 of 6 files are left out, the first is ad/lisez-moi ?.txt");
}

TEST(ModArchive, NamesThatLeadOutsideOrAreNotEverySystems) {
  const std::pair<const char*, const char*> names[] = {{"../x", "its name leads outside"},
                                                       {"maps/../../x", "its name leads outside"},
                                                       {"/etc/x", "its name leads outside"},
                                                       {"..", "its name leads outside"},
                                                       {"c:/x", "colon"},
                                                       {"x:stream", "colon"},
                                                       {"maps\\a.bsp", "backslash"},
                                                       {"..\\x", "backslash"},
                                                       {"a//b", "not the same"},
                                                       {"./x", "not the same"},
                                                       {"a/./b", "not the same"},
                                                       {"x.", "not the same"},
                                                       {"x ", "not the same"},
                                                       {" x", "not the same"},
                                                       {"dir./x", "not the same"},
                                                       {"what?", "a letter that no file"},
                                                       {"a\nb", "a letter that no file"},
                                                       {"a\x7f", "a letter that no file"},
                                                       {"CON", "a device's"},
                                                       {"gfx/nul.lmp", "a device's"},
                                                       {"maps/Com1.bsp", "a device's"},
                                                       {"", "it has no name"},
                                                       {"../", "its name leads outside"},
                                                       {"\xe9/../../x", "its name leads outside"},
                                                       {".git/../../x", "its name leads outside"}};
  for (const auto& [name, why] : names) EXPECT_THAT(refused({name, "x"}), HasSubstr(why)) << name;
  EXPECT_EQ(refused({"../x", "x"}), "\"../x\" in it: its name leads outside of the mod's folder");
  EXPECT_EQ(refused({"a\x1b[31m?", "x"}).find('\x1b'), std::string::npos) << "the sentence is shown";
  EXPECT_THAT(refused({std::string(241, 'x'), "x"}), HasSubstr("longer than 240"));
  EXPECT_THAT(refused({std::string(121, 'x'), "x"}), HasSubstr("a part longer than 120"));
  std::string deep;
  for (int i = 0; i < 17; ++i) deep += "d/";
  EXPECT_THAT(refused({deep + "x", "x"}), HasSubstr("more than 16 folders deep"));
  for (const char* sound : {"command.cfg", "com10", "a..b", "a b", "x+~-_!()[]{}'&%$#@,;=.x"})
    EXPECT_EQ(name_fault(sound), "") << sound;
}

TEST(ModArchive, NamesThatMeet) {
  EXPECT_THAT(refused({"progs.dat", "second"}), HasSubstr("there is another of its name"));
  EXPECT_THAT(refused({"PROGS.dat", "x"}), HasSubstr("it differs from \"progs.dat\" by case alone"));
  EXPECT_THAT(refused({"progs.dat/x", "x"}), HasSubstr("it is a file and a folder"));
  EXPECT_THAT(planned({{"progs.dat", "x"}, {"a/b", "x"}, {"a", "x"}}), HasSubstr("it is a file and a folder"));
  EXPECT_THAT(planned({{"progs.dat", "x"}, {"Gfx/a", "x"}, {"gfx/b", "x"}}), HasSubstr("by case alone"));
  EXPECT_EQ(planned({{"progs.dat", "x"}, {"gfx/", ""}, {"gfx/", ""}, {"gfx/b", "x"}}), "ad: progs.dat gfx/b");
}

TEST(ModArchive, LinksAndDevices) {
  EXPECT_EQ(refused({"link", "/etc/passwd", {}, 0, 0, 0, 0120777}), "\"link\" in it: it is a link or a device");
  EXPECT_THAT(refused({"pipe", "", {}, 0, 0, 0, 0010644}), HasSubstr("a link or a device"));
  EXPECT_THAT(refused({"folder/", "/etc", {}, 0, 0, 0, 0120777}), HasSubstr("a link or a device"));
  EXPECT_EQ(planned({{"progs.dat", "x", {}, 0, 0, 0, 0100755}, {"a/", "", {}, 0, 0, 0, 0040755}}), "ad: progs.dat");
}

TEST(ModArchive, PackedInWaysThatAreNotRead) {
  EXPECT_THAT(refused({"secret", "x", "x", 0, 1}), HasSubstr("it is encrypted"));
  EXPECT_THAT(refused({"bzip", "x", "x", 12}), HasSubstr("packed by method 12"));
  EXPECT_THAT(refused({"bomb", "x", deflated("x"), 8, 0, 7000}), HasSubstr("cannot hold them"));
  EXPECT_THAT(refused({"huge", "x", deflated("x"), 8, 0, 0xfffffff0u}), HasSubstr("of 2147483648 that are read"));
}

TEST(ModArchive, SumsBeyondLimits) {
  const std::vector<ZippedFile> files = {{"progs.dat", std::string(100, 'a')}, {"b", std::string(100, 'b')}};
  const auto refused_with = [&](const ModLimits& limits) {
    const auto archive = archive_of(files, "ad.zip", limits);
    return archive ? "planned" : archive.error().message;
  };
  EXPECT_EQ(refused_with({.entries = 2, .bytes = 200, .file_bytes = 100}), "planned");
  EXPECT_EQ(refused_with({.entries = 1}), "ad.zip: it has 2 files, of 1 that a mod may have");
  EXPECT_EQ(refused_with({.bytes = 199}), "ad.zip: its files are more than the 199 bytes of a mod");
  EXPECT_THAT(refused_with({.file_bytes = 99}), HasSubstr("it claims 100 bytes, of 99 that are read"));
  const std::vector<ZippedFile> bomb = {{"progs.dat", "x", std::string(1000, 'x'), 8, 0, 1000000}};
  EXPECT_TRUE(archive_of(bomb)) << "small ones may be what they like";
  EXPECT_EQ(archive_of(bomb, "ad.zip", {.ratio_from = 999999}).error().message,
            "ad.zip: its files unpack to more than 100 times its size");
}

// Two entries whose bytes are the same ones: an archive of a megabyte could so hold petabytes.
TEST(ModArchive, FilesThatShareTheirBytes) {
  Bytes zip = make_zip({{"progs.dat", std::string(4000, 'x')}, {"progs.da2", "x"}});
  const std::string text(zip.begin(), zip.end());
  const std::size_t second = text.rfind("PK\x01\x02");
  for (const std::size_t at : {second + 20, second + 24}) {  // packed and unpacked size
    zip[at] = 0xa0;
    zip[at + 1] = 0x0f;
  }
  for (std::size_t i = 0; i < 4; ++i) zip[second + 42 + i] = 0;  // where the first one is
  const auto archive = ModArchive::open(FileData(std::move(zip)), "ad.zip");
  EXPECT_EQ(archive ? "planned" : archive.error().message,
            "ad.zip: its files share their packed bytes, as in no sound archive");
}

TEST(ModArchive, FilesThatAreNotWhatTheyClaim) {
  const auto archive = archive_of({{"progs.dat", "alpha"},
                                   {"good", "beta", deflated("beta"), 8},
                                   {"longer", "abcdefgh", deflated("abc"), 8},
                                   {"shorter", "abc", deflated("abcdefgh"), 8, 0, 3},
                                   {"garbage", "abc", "\xff\xff\xff\xff", 8},
                                   {"changed", "abc", "abd"}});
  ASSERT_TRUE(archive) << archive.error().message;
  std::vector<std::string> read;
  for (const PlannedFile& file : (*archive)->plan().files) {
    std::string text;
    const Status status = (*archive)->read(file, [&](ByteView part) {
      text += as_text(part);
      return ok_status();
    });
    read.push_back(status ? text : status.error().message);
  }
  EXPECT_THAT(read, ElementsAre("alpha", "beta", StartsWith("ad.zip: longer in it is damaged: "),
                                StartsWith("ad.zip: shorter in it is damaged: "),
                                StartsWith("ad.zip: garbage in it is damaged: "),
                                StartsWith("ad.zip: changed in it is damaged: ")));
}

TEST(ModArchive, WhatIsNoArchive) {
  const TestDirectory directory;
  directory.put("text.zip", std::string_view("no archive at all"));
  directory.put("empty.zip", std::string_view());
  for (const char* name : {"text.zip", "empty.zip", "none.zip", "."}) {
    const auto archive = ModArchive::open(directory.file(name));
    ASSERT_FALSE(archive) << name;
    EXPECT_THAT(archive.error().message, HasSubstr(": ")) << name;
  }
  const Bytes good = make_zip({{"progs.dat", "alpha"}, {"b", "beta", deflated("beta"), 8}});
  for (std::size_t size = 1; size < good.size(); ++size)
    ASSERT_FALSE(
        ModArchive::open(FileData(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), "cut"))
        << size;
}

// Seconds, were each folder compared with each file.
TEST(ModArchive, ThousandsOfFoldersTakeNoTime) {
  std::vector<ZippedFile> files;
  for (int i = 0; i < 30000; ++i) files.push_back({"d" + std::to_string(i) + "/x", ""});
  EXPECT_THAT(planned(files), HasSubstr("there is no mod in it"));
}

}  // namespace
}  // namespace fb::fs
