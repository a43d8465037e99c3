#include "host/game/save_picture.h"

#include <gmock/gmock.h>

#include <array>

#include "base/test_directory.h"
#include "formats/image_write.h"
#include "ui/menu/facts.h"

namespace fb::host {
namespace {

constexpr std::uint32_t kWide = ui::menu::kSavePictureWidth, kHigh = ui::menu::kSavePictureHeight;

std::uint32_t grey(std::uint32_t level) { return level | level << 8u | level << 16u; }

class SavePicture : public testing::Test {
 protected:
  SavePicture() {
    directory.put("base/id1/progs.dat", "code");
    fs::FsOptions options;
    options.base_dir = directory.file("base");
    options.base_dir_named = true;
    options.user_dir = directory.file("user");
    auto opened = fs::FileSystem::open(options);
    EXPECT_TRUE(opened.ok()) << opened.error().message;
    files.emplace(*std::move(opened));
  }
  const TestDirectory directory;
  std::optional<fs::FileSystem> files;
};

TEST(SavePictureShrinks, ToTheMeanOfWhatAPixelCovers) {
  const uvec2 size(4 * kWide, 4 * kHigh);
  std::vector<std::uint32_t> pixels(std::size_t{size.x} * size.y);
  for (std::uint32_t y = 0; y < size.y; ++y)
    for (std::uint32_t x = 0; x < size.x; ++x)
      pixels[std::size_t{y} * size.x + x] = grey(x / 4 % 200) + (x % 2 == 0 ? 0u : grey(2)) + (y < 4 ? 9u : 0u);
  const auto small = shrink_to_save_picture(pixels, size);
  ASSERT_EQ(small.size(), std::size_t{kWide} * kHigh);
  for (std::uint32_t x = 0; x < kWide; ++x) {
    EXPECT_EQ(small[x], 0xff000000u | (grey(x + 1) + 9u)) << x;
    EXPECT_EQ(small[kWide + x], 0xff000000u | grey(x + 1)) << x;
  }
}

// The middle of what is wider or higher; small pictures grow.
TEST(SavePictureShrinks, AnyShape) {
  for (const uvec2 size :
       {uvec2(1, 1), uvec2(7, 3), uvec2(1000, 20), uvec2(20, 1000), uvec2(640, 480), uvec2(161, 91)}) {
    std::vector<std::uint32_t> pixels(std::size_t{size.x} * size.y, grey(50));
    if (size.x >= 1000) pixels[0] = pixels[pixels.size() - 1] = grey(255);  // corners, which are left out
    const auto small = shrink_to_save_picture(pixels, size);
    EXPECT_THAT(small, testing::Each(0xff000000u | grey(50))) << size.x << "x" << size.y;
  }
}

TEST_F(SavePicture, ComesBack) {
  std::vector<std::uint32_t> pixels(std::size_t{kWide} * kHigh, 0xff332211u);
  pixels[1] = 0xff0000feu;
  ASSERT_TRUE(write_save_picture(*files, "autosave/e1m1", pixels, {kWide, kHigh}).ok());
  EXPECT_TRUE(std::filesystem::exists(directory.file("user/id1/autosave/e1m1.png")));
  const auto image = read_save_picture(*files, "autosave/e1m1");
  ASSERT_TRUE(image.has_value());
  EXPECT_THAT(std::vector(image->rgba.begin(), image->rgba.begin() + 8),
              testing::ElementsAre(0x11, 0x22, 0x33, 255, 0xfe, 0, 0, 255));
}

TEST_F(SavePicture, OthersAreNotShown) {
  EXPECT_FALSE(read_save_picture(*files, "s0").has_value());
  directory.put("user/id1/s0.png", "no picture");
  EXPECT_FALSE(read_save_picture(*files, "s0").has_value());
  const std::array<std::uint32_t, 4> tiny{};
  const auto png = formats::encode_png(2, 2, tiny);
  ASSERT_TRUE(png.ok());
  directory.put("user/id1/s0.png", *png);
  EXPECT_FALSE(read_save_picture(*files, "s0").has_value()) << "another size";
}

TEST_F(SavePicture, WhatCannotBeWrittenIsOneSentence) {
  directory.put("user/id1/autosave", "a file where a folder should be");
  const std::vector<std::uint32_t> pixels(4);
  const auto status = write_save_picture(*files, "autosave/x", pixels, {2, 2});
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, testing::HasSubstr("autosave/x.png: "));
}

}  // namespace
}  // namespace fb::host
