#include "ui/atlas.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/librequake.h"
#include "base/log.h"
#include "fs/filesystem.h"

namespace fb::ui {
namespace {

std::uint32_t texel(const Atlas& atlas, int x, int y) {
  const auto image = atlas.image();
  return image->texels[static_cast<std::size_t>(y * image->width + x)];
}

// A glyph's pixels, row by row.
std::string shape(const Atlas& atlas, unsigned char code) {
  const Picture place = atlas.glyph(code);
  std::string pixels;
  for (int y = 0; y < place.height; ++y) {
    for (int x = 0; x < place.width; ++x) pixels += (texel(atlas, place.x + x, place.y + y) >> 24u) != 0 ? '#' : '.';
  }
  return pixels;
}

Bytes picture_bytes(int width, int height, std::uint8_t index) {
  Bytes data;
  for (const int value : {width, height}) {
    for (int shift = 0; shift < 32; shift += 8) data.push_back(static_cast<std::uint8_t>(value >> shift));
  }
  data.resize(8 + static_cast<std::size_t>(width * height), index);
  return data;
}

// A palette in which index i is (i, 0, 255 - i), and what else is given.
FileLoader files_with(std::map<std::string, Bytes> files) {
  Bytes palette;
  for (int i = 0; i < 256; ++i) {
    palette.push_back(static_cast<std::uint8_t>(i));
    palette.push_back(0);
    palette.push_back(static_cast<std::uint8_t>(255 - i));
  }
  files["gfx/palette.lmp"] = palette;
  return [files](std::string_view name) -> std::optional<Bytes> {
    const auto found = files.find(std::string(name));
    if (found == files.end()) return std::nullopt;
    return found->second;
  };
}

TEST(Atlas, EveryPrintableCharacterHasItsOwnShape) {
  const Atlas atlas;
  EXPECT_FALSE(atlas.has_game_font());
  std::set<std::string> shapes;
  for (int code = '!'; code < 127; ++code) shapes.insert(shape(atlas, static_cast<unsigned char>(code)));
  EXPECT_EQ(shapes.size(), 94u);
  EXPECT_EQ(shape(atlas, ' '), std::string(64, '.'));
  EXPECT_EQ(shape(atlas, 'T'),
            ".#####.."
            "...#...."
            "...#...."
            "...#...."
            "...#...."
            "...#...."
            "...#...."
            "........");
}

TEST(Atlas, UpperHalfIsTheSameInGold) {
  const Atlas atlas;
  for (const unsigned char code : {'A', '!', 'z'}) {
    EXPECT_EQ(shape(atlas, code), shape(atlas, code + 128));
    EXPECT_NE(shape(atlas, code), shape(atlas, ' '));
  }
  std::set<std::uint32_t> white, gold;
  const Picture low = atlas.glyph('E'), high = atlas.glyph('E' + 128);
  for (int i = 0; i < 64; ++i) {
    white.insert(texel(atlas, low.x + i % 8, low.y + i / 8));
    gold.insert(texel(atlas, high.x + i % 8, high.y + i / 8));
  }
  EXPECT_EQ(white.size(), 2u);
  EXPECT_EQ(gold.size(), 2u);
  EXPECT_NE(white, gold);
  EXPECT_EQ(shape(atlas, 0x12), shape(atlas, '0')) << "Quake's golden digits";
}

TEST(Atlas, PicturesComeOnDemandWithTransparency) {
  Bytes data = picture_bytes(3, 2, 7);
  data[8] = 255;
  Atlas atlas(files_with({{"gfx/x.lmp", data}}));
  const auto before = atlas.image();
  const Picture* picture = atlas.picture("gfx/x.lmp");
  ASSERT_NE(picture, nullptr);
  EXPECT_EQ(picture->width, 3);
  EXPECT_EQ(picture->height, 2);
  EXPECT_EQ(texel(atlas, picture->x, picture->y), 0u);
  EXPECT_EQ(texel(atlas, picture->x + 1, picture->y), 0xff000000u | 248u << 16u | 7u);
  EXPECT_GT(atlas.image()->revision, before->revision);
  const auto after = atlas.image();
  EXPECT_EQ(atlas.picture("gfx/x.lmp"), picture);
  EXPECT_EQ(atlas.image(), after) << "a second look adds nothing";
}

TEST(Atlas, WhatIsMissingOrMalformedIsDoneWithout) {
  Atlas atlas(files_with({{"gfx/short.lmp", Bytes{1, 2, 3}},
                          {"gfx/wide.lmp", picture_bytes(Atlas::kWidth + 1, 1, 0)},
                          {"gfx.wad", Bytes{'W', 'A', 'D', '9'}}}));
  EXPECT_FALSE(atlas.has_game_font());
  for (const char* name : {"gfx/none.lmp", "gfx/short.lmp", "gfx/wide.lmp", "ibar"})
    EXPECT_EQ(atlas.picture(name), nullptr) << name;
  Atlas without;
  EXPECT_EQ(without.picture("gfx/x.lmp"), nullptr);
}

TEST(Atlas, PicturesDoNotOverlapAndFullIsFull) {
  std::map<std::string, Bytes> files;
  for (int i = 0; i < 60; ++i)
    files["gfx/" + std::to_string(i) + ".lmp"] =
        picture_bytes(300 + 7 * i % 50, 200 + 11 * i % 60, static_cast<std::uint8_t>(i + 1));
  Atlas atlas(files_with(files));
  std::vector<Picture> placed;
  for (int i = 0; i < 60; ++i) {
    const Picture* picture = atlas.picture("gfx/" + std::to_string(i) + ".lmp");
    if (picture == nullptr) continue;
    placed.push_back(*picture);
    EXPECT_LE(picture->x + picture->width, Atlas::kWidth);
    EXPECT_LE(picture->y + picture->height, atlas.image()->height);
  }
  EXPECT_GT(placed.size(), 30u);
  EXPECT_LT(placed.size(), 60u);
  EXPECT_LE(atlas.image()->height, Atlas::kMaxHeight);
  for (std::size_t a = 0; a < placed.size(); ++a) {
    EXPECT_TRUE(placed[a].y >= 128 || placed[a].x >= 128) << "over the font";
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_TRUE(placed[a].x >= placed[b].x + placed[b].width || placed[b].x >= placed[a].x + placed[a].width ||
                  placed[a].y >= placed[b].y + placed[b].height || placed[b].y >= placed[a].y + placed[a].height)
          << a << " and " << b;
    }
  }
}

TEST(Atlas, AnImageMayBeReplaced) {
  Atlas atlas;
  const auto image = [](std::uint8_t level) {
    formats::RgbaImage made{3, 2, {}};
    made.rgba.assign(24, level);
    return made;
  };
  ASSERT_TRUE(atlas.replace("save", image(0x40)));
  const Picture place = *atlas.picture("save");
  const std::uint64_t revision = atlas.image()->revision;
  EXPECT_EQ(texel(atlas, place.x + 2, place.y + 1), 0x40404040u);
  ASSERT_TRUE(atlas.replace("save", image(0x60)));
  EXPECT_EQ(atlas.picture("save")->x, place.x);
  EXPECT_EQ(texel(atlas, place.x, place.y), 0x60606060u);
  EXPECT_NE(atlas.image()->revision, revision);
  EXPECT_FALSE(atlas.replace("wide", {Atlas::kWidth + 1, 1, std::vector<std::uint8_t>(4 * (Atlas::kWidth + 1))}));
}

TEST(Atlas, RealData) {
  if (const std::string lacks = librequake_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  fs::FsOptions options;
  options.base_dir = librequake_folder();
  options.user_dir.emplace();
  const auto files = fs::FileSystem::open(options);
  ASSERT_TRUE(files) << files.error().message;
  Atlas atlas(files->loader());
  EXPECT_TRUE(atlas.has_game_font());
  EXPECT_NE(shape(atlas, 'A'), shape(atlas, 'B'));
  ASSERT_NE(atlas.picture("gfx/conback.lmp"), nullptr);
  EXPECT_EQ(atlas.picture("gfx/conback.lmp")->width, 320);
  ASSERT_NE(atlas.picture("sbar"), nullptr);
  EXPECT_EQ(atlas.picture("num_0")->width, 24);
}

TEST(Atlas, OneMessageForAMissingWadAndOneForEachMissingPicture) {
  std::vector<std::string> said;
  const int listener = add_log_listener([&](LogLevel, std::string_view line) { said.emplace_back(line); });
  Atlas atlas;
  for (int i = 0; i < 2; ++i) {
    for (const char* name : {"sbar", "ibar", "num_0"}) EXPECT_EQ(atlas.picture(name), nullptr);
    EXPECT_EQ(atlas.picture("gfx/pause.lmp"), nullptr);
  }
  remove_log_listener(listener);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_NE(said[0].find("sbar: there is no gfx.wad"), std::string::npos);
  EXPECT_NE(said[1].find("gfx/pause.lmp"), std::string::npos);
}

}  // namespace
}  // namespace fb::ui
