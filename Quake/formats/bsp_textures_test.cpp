// The texture lump: a damaged entry becomes a missing texture and a warning; of a damaged directory what fits counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "formats/bsp.h"
#include "formats/test_bsp.h"
#include "formats/test_bytes.h"

namespace fb::formats {
namespace {

using testing::box_room;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::write_bsp;

class TextureLump : public ::testing::Test {
 protected:
  // The room with its texture lump as `edit` leaves it; offsets in the lump: 16 wall, then outside.
  template <typename Edit>
  Result<Bsp> parse_with(const Edit& edit) {
    const Bytes valid = write_bsp(box_room(BspVersion::kBsp29));
    testing::ByteWriter file{valid};
    std::uint32_t lump = 0;
    std::memcpy(&lump, valid.data() + 4 + 8 * 2, 4);
    edit(file, lump);
    return parse_bsp(file.out, "maps/x.bsp");
  }
};

TEST_F(TextureLump, OffsetOutside) {
  const auto bsp = parse_with([](auto& file, std::uint32_t lump) { file.patch_u32(lump + 4, 0x7fffffff); });
  ASSERT_TRUE(bsp.ok());
  EXPECT_TRUE(bsp->textures[0].missing());
  EXPECT_EQ(bsp->textures[0].width, 16);
  EXPECT_THAT(bsp->warnings, Contains(HasSubstr("texture lies outside its lump")));
}
TEST_F(TextureLump, TexelsOutside) {
  const auto bsp = parse_with([](auto& file, std::uint32_t lump) { file.patch_u32(lump + 16 + 16, 4096); });
  ASSERT_TRUE(bsp.ok());
  EXPECT_TRUE(bsp->textures[0].missing());
  EXPECT_EQ(bsp->textures[0].name, "wall");
  EXPECT_THAT(bsp->warnings, Contains(HasSubstr("runs past the end of its lump")));
}
TEST_F(TextureLump, ImpossibleSize) {
  for (const std::uint32_t size : {0u, 0xffffffffu, 16385u}) {
    const auto bsp = parse_with([&](auto& file, std::uint32_t lump) { file.patch_u32(lump + 16 + 20, size); });
    ASSERT_TRUE(bsp.ok());
    EXPECT_TRUE(bsp->textures[0].missing());
    EXPECT_THAT(bsp->warnings, Contains(HasSubstr("impossible size")));
  }
}
TEST_F(TextureLump, WrongOffsetOfTexelsMeansBehindTheHeader) {
  const auto bsp = parse_with([](auto& file, std::uint32_t lump) { file.patch_u32(lump + 16 + 24, 0x01010101); });
  ASSERT_TRUE(bsp.ok());
  EXPECT_EQ(bsp->textures[0].indices, box_room(BspVersion::kBsp29).textures[0].indices);
}
TEST_F(TextureLump, DirectoryTooLarge) {
  for (const std::uint32_t count : {0xffffffffu, 0x40000000u, 100000u}) {
    const auto bsp = parse_with([&](auto& file, std::uint32_t lump) { file.patch_u32(lump, count); });
    ASSERT_TRUE(bsp.ok());
    EXPECT_THAT(bsp->warnings, Contains(HasSubstr("too small for its directory")));
    EXPECT_EQ(bsp->textures[0].name, "wall");
    EXPECT_LT(bsp->textures.size(), write_bsp(box_room(BspVersion::kBsp29)).size() / 4);
  }
}

// As QuakeSpasm calls them, so that two are two and an image can replace each.
TEST_F(TextureLump, WithoutAName) {
  const auto bsp = parse_with([](auto& file, std::uint32_t lump) {
    for (std::size_t i = 0; i < 16; i += 4) file.patch_u32(lump + 16 + i, 0);
  });
  ASSERT_TRUE(bsp.ok());
  EXPECT_EQ(bsp->textures[0].name, "unnamed0");
  EXPECT_EQ(bsp->textures[0].indices, box_room(BspVersion::kBsp29).textures[0].indices);
  EXPECT_EQ(bsp->textures[2].name, "") << "there is none";
  EXPECT_THAT(bsp->warnings, Contains(HasSubstr("texture has no name")));
}

// A directory that names one texture a thousand times does not cost a thousand times its memory.
TEST(TextureLumpMemory, IsNotMultiplied) {
  Bsp room = box_room(BspVersion::kBsp29);
  room.textures.assign(1000, BspTexture{"", 16, 16, {}});
  room.textures[0] = {"wall", 64, 64, std::vector<std::uint8_t>(4096, 5)};
  Bytes file = write_bsp(room);
  std::uint32_t lump = 0;
  std::memcpy(&lump, file.data() + 4 + 8 * 2, 4);
  testing::ByteWriter edited{file};
  for (std::uint32_t i = 0; i < 1000; ++i) edited.patch_u32(lump + 4 + 4 * i, 4 + 4 * 1000);
  const auto bsp = parse_bsp(edited.out, "maps/x.bsp");
  ASSERT_TRUE(bsp.ok());
  std::size_t texels = 0;
  for (const BspTexture& texture : bsp->textures) texels += texture.indices.size();
  EXPECT_LE(texels, edited.out.size());
  EXPECT_GE(texels, 4096u);
}

}  // namespace
}  // namespace fb::formats
