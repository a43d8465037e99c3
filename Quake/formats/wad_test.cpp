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
TEST(Wad, LumpsOutsideAndContradictions) {
  const Bytes valid = small_wad();
  const std::size_t entry = valid.size() - 3 * 32;
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
  refused(entry, 0xffffffffu, "lump disc");
  refused(entry + 8, 0xffffffffu, "lies outside the file");
  refused(entry + 8, static_cast<std::uint32_t>(valid.size() - 12 + 1), "lies outside the file");
  refused(0, 0x33444157u, "WAD2");
}

// Tools leave rubbish in the fields that Quake never reads; only both together mean a compressed lump.
TEST(Wad, CompressedLumps) {
  testing::ByteWriter file{small_wad()};
  const std::size_t entry = file.out.size() - 3 * 32;
  file.patch_u32(entry + 4, 1);
  EXPECT_TRUE(Wad::parse(file.out, "gfx.wad").ok());
  file.patch_u32(entry + 12, 0x0142);
  const auto refused = Wad::parse(file.out, "gfx.wad");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("lump disc is compressed"));
}

}  // namespace
}  // namespace fb::formats
