// WAD2 archives: lookup, pictures, console characters, damage.
#include "formats/wad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/invariants.h"
#include "formats/test_bytes.h"
#include "formats/test_corruption.h"
#include "formats/test_files.h"

namespace fb::formats {
namespace {

using ::testing::HasSubstr;
using testing::small_wad;
using testing::write_lmp;
using testing::write_wad;

const testing::Attempt kAttempt = testing::attempt([](const Bytes& bytes) { return Wad::parse(bytes, "gfx.wad"); },
                                                   [](const Wad& wad) {
                                                     for (const auto& [name, lump] : wad.lumps()) {
                                                       if (wad.lump(name).size() != lump.size)
                                                         return std::string("a lump's size");
                                                       (void)wad.picture(name);
                                                     }
                                                     (void)wad.conchars();
                                                     return std::string();
                                                   });

TEST(Wad, FindsLumpsInAnyCase) {
  const auto wad = Wad::parse(small_wad(), "gfx.wad");
  ASSERT_TRUE(wad.ok()) << wad.error().message;
  EXPECT_EQ(wad->lumps().size(), 3u);
  EXPECT_EQ(wad->lump("PALETTE").size(), 768u);
  EXPECT_TRUE(wad->lump("nothing").empty());
  const auto picture = wad->picture("disc");
  ASSERT_TRUE(picture.ok());
  EXPECT_EQ(picture->width, 5);
  EXPECT_EQ(picture->height, 3);
  EXPECT_EQ(picture->indices, testing::small_picture().indices);
  const auto conchars = wad->conchars();
  ASSERT_TRUE(conchars.ok());
  EXPECT_EQ(conchars->width, 128);
  EXPECT_EQ(conchars->indices.size(), 128u * 128u);
}
TEST(Wad, FirstOfTwoCounts) {
  const auto wad = Wad::parse(write_wad({{"a", 'B', Bytes(3)}, {"A", 'B', Bytes(5)}}), "gfx.wad");
  ASSERT_TRUE(wad.ok());
  EXPECT_EQ(wad->lump("a").size(), 3u);
}
TEST(Wad, MovedArchiveKeepsItsBytes) {
  auto wad = Wad::parse(small_wad(), "gfx.wad");
  ASSERT_TRUE(wad.ok());
  const Wad moved = std::move(*wad);
  EXPECT_TRUE(moved.picture("disc").ok());
}
TEST(Wad, AbsentOrBadPicturesAreNamed) {
  const auto wad = Wad::parse(write_wad({{"conchars", 'D', Bytes(100)}, {"bad", 'B', Bytes(9, 1)}}), "gfx.wad");
  ASSERT_TRUE(wad.ok());
  EXPECT_EQ(wad->picture("num_0").error().message, "gfx.wad: has no lump num_0");
  EXPECT_THAT(wad->picture("bad").error().message, HasSubstr("gfx.wad:bad"));
  EXPECT_THAT(wad->picture("bad").error().message, HasSubstr("offset"));
  EXPECT_THAT(wad->conchars().error().message, HasSubstr("too few"));
}
TEST(Wad, RefusedWhenCut) {
  testing::expect_refused_when_cut(kAttempt, write_wad({{"disc", 'B', write_lmp(testing::small_picture())}}),
                                   "gfx.wad");
}
TEST(Wad, SoundWhenDamaged) {
  testing::expect_sound_when_damaged(
      kAttempt, write_wad({{"disc", 'B', write_lmp(testing::small_picture())}, {"conchars", 'D', Bytes(10)}}),
      "gfx.wad");
}
TEST(Wad, ContradictionsAreRefused) {
  const Bytes valid = small_wad();
  const auto refused = [&](std::size_t at, std::uint32_t value, const std::string& cause) {
    testing::ByteWriter file{valid};
    file.patch_u32(at, value);
    const auto wad = Wad::parse(file.out, "gfx.wad");
    ASSERT_FALSE(wad.ok()) << cause;
    EXPECT_THAT(wad.error().message, HasSubstr(cause));
  };
  refused(4, 0xffffffffu, "directory of 4294967295 lumps");
  refused(4, 4, "directory of 4 lumps");
  refused(8, 0xfffffff0u, "runs past the end");
  refused(0, 0x33444157u, "WAD2");
}

// An archive of which a part was lost, or one tool's mistake: a status bar wants its other pictures.
TEST(Wad, ALumpOutsideIsLeftOutAlone) {
  const Bytes valid = small_wad();
  const std::size_t entry = valid.size() - 3 * 32;
  for (const auto& [field, value] : {std::pair<std::size_t, std::uint32_t>{0, 0xffffffffu},
                                     {8, 0xffffffffu},
                                     {8, static_cast<std::uint32_t>(valid.size() - 12 + 1)}}) {
    testing::ByteWriter file{valid};
    file.patch_u32(entry + field, value);
    const auto wad = Wad::parse(file.out, "gfx.wad");
    ASSERT_TRUE(wad.ok()) << wad.error().message;
    EXPECT_EQ(wad->lumps().size(), 2u);
    EXPECT_TRUE(wad->conchars().ok());
    EXPECT_EQ(wad->picture("disc").error().message, "gfx.wad: has no lump disc");
    ASSERT_EQ(wad->warnings().size(), 1u);
    EXPECT_THAT(wad->warnings()[0], HasSubstr("lump disc"));
    EXPECT_THAT(wad->warnings()[0], HasSubstr("lies outside the file; it is left out"));
    EXPECT_TRUE(testing::names_place(wad->warnings()[0], "gfx.wad", file.out.size()));
  }
}
TEST(Wad, ManyLumpsOutsideAreFewSentences) {
  std::vector<testing::NamedLump> lumps;
  for (int i = 0; i < 100; ++i) lumps.push_back({"lump" + std::to_string(i), 'B', Bytes(1)});
  testing::ByteWriter file{write_wad(lumps)};
  for (std::size_t i = 0; i < 99; ++i) file.patch_u32(file.out.size() - 32 * (i + 1), 0x7fffffffu);
  const auto wad = Wad::parse(file.out, "gfx.wad");
  ASSERT_TRUE(wad.ok());
  EXPECT_EQ(wad->lumps().size(), 1u);
  ASSERT_EQ(wad->warnings().size(), 8u);
  EXPECT_THAT(wad->warnings().back(), HasSubstr("(and 91 more)"));
}

// Tools leave rubbish in the fields that Quake never reads; only both together mean a compressed lump.
TEST(Wad, CompressedLumps) {
  testing::ByteWriter file{small_wad()};
  const std::size_t entry = file.out.size() - 3 * 32;
  file.patch_u32(entry + 4, 1);
  EXPECT_EQ(Wad::parse(file.out, "gfx.wad")->lumps().size(), 3u);
  file.patch_u32(entry + 12, 0x0142);
  const auto wad = Wad::parse(file.out, "gfx.wad");
  ASSERT_TRUE(wad.ok());
  EXPECT_EQ(wad->lumps().size(), 2u);
  ASSERT_EQ(wad->warnings().size(), 1u);
  EXPECT_THAT(wad->warnings()[0], HasSubstr("lump disc is compressed"));
}

}  // namespace
}  // namespace fb::formats
