// Images beyond the budget of texels become smaller: which, how they look then, and that a game of them goes on.
#include "scene/library/texel_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "base/log.h"
#include "formats/image_write.h"
#include "scene/library/asset_builder.h"
#include "scene/library/test_maps.h"

namespace fb::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Image image(ImageEncoding encoding, int width, int height, std::vector<std::uint8_t> texels) {
  return {"made", encoding, width, height, std::move(texels)};
}
Image plain(int side) {
  return image(ImageEncoding::kSrgba, side, side,
               std::vector<std::uint8_t>(4 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 255));
}

std::uint64_t bytes_of(const std::vector<Image>& images) {
  return std::accumulate(images.begin(), images.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Image& i) { return sum + texel_bytes(i); });
}

// 0 and 255 in equal parts are half the light, which sRGB encodes as 188; a hole adds no colour.
TEST(TexelBudget, HalvesByTheLightOfWhatCovers) {
  Image colors = image(ImageEncoding::kSrgba, 2, 2,
                       {0, 0, 0, 255, 255, 255, 255, 255,  //
                        255, 0, 0, 255, 0, 255, 255, 255});
  halve(colors);
  EXPECT_EQ(colors.width, 1);
  EXPECT_EQ(colors.height, 1);
  EXPECT_THAT(colors.texels, ElementsAre(188, 188, 188, 255));
  Image hole = image(ImageEncoding::kSrgba, 2, 2,
                     {200, 100, 50, 255, 0, 0, 0, 0,  //
                      200, 100, 50, 255, 0, 0, 0, 0});
  halve(hole);
  EXPECT_THAT(hole.texels, ElementsAre(200, 100, 50, 128));
  Image nothing = image(ImageEncoding::kSrgba, 2, 1, {80, 80, 80, 0, 80, 80, 80, 0});
  halve(nothing);
  EXPECT_THAT(nothing.texels, ElementsAre(80, 80, 80, 0));
}

TEST(TexelBudget, EverySrgbByteStaysItself) {
  for (int byte = 0; byte < 256; ++byte) {
    const auto b = static_cast<std::uint8_t>(byte);
    Image same = image(ImageEncoding::kSrgba, 2, 1, {b, b, b, 255, b, b, b, 255});
    halve(same);
    EXPECT_THAT(same.texels, ElementsAre(b, b, b, 255));
  }
}

TEST(TexelBudget, HalvesOtherEncodingsAndOddSides) {
  Image indices = image(ImageEncoding::kPalette, 5, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
  halve(indices);
  EXPECT_EQ(indices.width, 2);
  EXPECT_EQ(indices.height, 1);
  EXPECT_THAT(indices.texels, ElementsAre(1, 3));
  Image column = image(ImageEncoding::kLinearGray, 1, 4, {10, 20, 30, 40});
  halve(column);
  EXPECT_THAT(column.texels, ElementsAre(15, 35));
  Image normals = image(ImageEncoding::kLinearRgba, 2, 1, {0, 100, 255, 255, 100, 100, 255, 255});
  halve(normals);
  EXPECT_THAT(normals.texels, ElementsAre(50, 100, 255, 255));
}

TEST(TexelBudget, TheLargestAreHalvedUntilAllFit) {
  std::vector<Image> images{plain(8), plain(64), plain(32), plain(64), plain(1)};
  EXPECT_EQ(halve_largest(images, bytes_of(images)), 0u);
  // 64x64 are 16 KiB: one must go, and the first does.
  EXPECT_EQ(halve_largest(images, bytes_of(images) - 1), 1u);
  EXPECT_EQ(images[1].width, 32);
  EXPECT_EQ(images[3].width, 64);
  EXPECT_EQ(halve_largest(images, 3000), 3u);
  EXPECT_LE(bytes_of(images), 3000u);
  EXPECT_EQ(images[0].width, 8) << "the smallest stays";
  EXPECT_EQ(halve_largest(images, 0), 4u);
  for (const Image& i : images) EXPECT_EQ(i.width * i.height, 1);
}

struct Said {
  Said() {
    handle = add_log_listener([this](LogLevel, std::string_view line) { lines.emplace_back(line); });
  }
  ~Said() { remove_log_listener(handle); }
  std::vector<std::string> lines;
  int handle;
};

// As a public report has it: small files that unpack to a thousand times as much.
TEST(TexelBudget, ManyImagesOfFilesTakeNoMoreThanIsAllowed) {
  test::TestFiles files;
  files.add_palette();
  const std::vector<std::uint32_t> black(std::size_t{256} * 256, 0xff000000u);
  const auto png = formats::encode_png(256, 256, black);
  ASSERT_TRUE(png.ok());
  ASSERT_LT(png->size(), 2000u);
  for (int i = 0; i < 40; ++i) files.files["textures/bomb" + std::to_string(i) + ".png"] = *png;
  const Said said;
  AssetBuilder builder(files.loader(), {}, 1u << 20);
  const std::uint64_t before = builder.assets().generation;
  for (int i = 0; i < 40; ++i) {
    const std::uint32_t index = builder.image_file("textures/bomb" + std::to_string(i), ImageEncoding::kSrgba);
    ASSERT_EQ(index, static_cast<std::uint32_t>(i));
    ASSERT_LE(bytes_of(builder.assets().images), 1u << 20);
  }
  EXPECT_NE(builder.assets().generation, before) << "whoever drew them takes them anew";
  EXPECT_GE(builder.assets().images.front().width, 32);
  EXPECT_THAT(said.lines, ElementsAre(HasSubstr("shown smaller than they are: all would take 1.2 MiB of 1.0 MiB")));
}

TEST(TexelBudget, WhatFitsStaysAsItIs) {
  AssetBuilder builder(nullptr, {}, 1u << 20);
  const std::uint64_t before = builder.assets().generation;
  for (int i = 0; i < 4; ++i) builder.add_image(plain(256));
  EXPECT_EQ(builder.assets().generation, before);
  for (const Image& i : builder.assets().images) EXPECT_EQ(i.width, 256);
  builder.set_most_texel_bytes(1u << 19);
  EXPECT_LE(bytes_of(builder.assets().images), 1u << 19);
}

TEST(TexelBudget, MoreMaterialsThanAnyGameHasLookLikeTheLast) {
  const Said said;
  AssetBuilder builder(nullptr);
  for (std::size_t i = 0; i < AssetBuilder::kMostMaterials; ++i) builder.add_material({});
  EXPECT_EQ(builder.add_material({}), AssetBuilder::kMostMaterials - 1);
  EXPECT_EQ(builder.add_material({}), AssetBuilder::kMostMaterials - 1);
  EXPECT_EQ(builder.assets().materials.size(), AssetBuilder::kMostMaterials);
  EXPECT_THAT(said.lines, ElementsAre(HasSubstr("palette.lmp"), HasSubstr("more than 131072 materials")));
}

}  // namespace
}  // namespace fb::scene
