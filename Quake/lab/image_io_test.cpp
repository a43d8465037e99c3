#include "lab/image_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "base/test_directory.h"
#include "formats/image.h"

namespace fb::lab {
namespace {

using ::testing::HasSubstr;
namespace fs_std = std::filesystem;

class ImageIoTest : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return directory_.file(name); }
  static Bytes contents(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
  }
  static void store(const std::string& name, const Bytes& data) {
    std::ofstream file(name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
  }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(
        std::distance(fs_std::directory_iterator(directory_.path()), fs_std::directory_iterator{}));
  }

  const TestDirectory directory_;
};

// Values of every magnitude and both signs, the same in every run.
std::vector<float> wide_values(std::size_t count) {
  std::vector<float> values(count);
  std::uint32_t state = 1;
  for (float& value : values) {
    state = state * 1664525u + 1013904223u;
    value = std::ldexp(static_cast<float>(state >> 8) - 8388608.0f, static_cast<int>(state % 60) - 50);
  }
  return values;
}

TEST_F(ImageIoTest, PngKeepsEveryByteAndItsOrder) {
  const std::uint32_t width = 7, height = 3;
  std::vector<std::uint32_t> pixels(width * height);
  for (std::uint32_t i = 0; i < pixels.size(); ++i)
    pixels[i] = 0xab000000u | (i * 3) | ((255 - i) << 8) | ((i * 11) << 16);
  ASSERT_TRUE(write_png(path("a.png"), width, height, pixels).ok());

  const Bytes file = contents(path("a.png"));
  const auto image = formats::parse_png(file, "a.png");
  ASSERT_TRUE(image.ok()) << image.error().message;
  ASSERT_EQ(image->width, 7);
  ASSERT_EQ(image->height, 3);
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    EXPECT_EQ(image->rgba[4 * i + 0], i * 3);
    EXPECT_EQ(image->rgba[4 * i + 1], 255 - i);
    EXPECT_EQ(image->rgba[4 * i + 2], i * 11);
    EXPECT_EQ(image->rgba[4 * i + 3], 255) << "the alpha of the frame is not the picture's";
  }
  EXPECT_EQ(files_in_folder(), 1u) << "a partial file was left behind";
}

TEST_F(ImageIoTest, ExrKeepsFloatsBitForBitInEveryChannel) {
  ExrImage image(37, 21);
  std::vector<float> red = wide_values(image.pixels());
  red[0] = std::numeric_limits<float>::infinity();
  red[1] = std::numeric_limits<float>::denorm_min();
  red[2] = -0.0f;
  image.add_channel("R", red);
  image.add_channel("G", std::vector<float>(image.pixels(), 0.25f));
  image.add_channel("B", std::vector<float>(image.pixels(), 70000.0f));
  image.add_channel("variance.R", wide_values(image.pixels()));
  image.set_text("fullbright.command", "fullbright-lab reference --spp 64");
  ASSERT_TRUE(write_exr(path("a.exr"), image).ok());

  const auto read = read_exr(path("a.exr"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->width(), 37u);
  EXPECT_EQ(read->height(), 21u);
  ASSERT_EQ(read->channels().size(), 4u);
  for (const auto& [name, plane] : image.channels()) {
    ASSERT_NE(read->channel(name), nullptr) << name;
    EXPECT_EQ(std::memcmp(read->channel(name)->data(), plane.data(), plane.size() * sizeof(float)), 0) << name;
  }
  EXPECT_EQ(read->channel("A"), nullptr);
  EXPECT_EQ(read->texts().at("fullbright.command"), "fullbright-lab reference --spp 64");
  EXPECT_EQ(files_in_folder(), 1u) << "a partial file was left behind";
}

TEST_F(ImageIoTest, HalfExrRoundsToElevenBits) {
  ExrImage image(64, 4);
  std::vector<float> values(image.pixels());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::exp2(static_cast<float>(i) / 17.0f - 10.0f);
  image.add_channel("R", values);
  ASSERT_TRUE(write_exr(path("half.exr"), image, ExrPixels::kHalf).ok());
  ASSERT_TRUE(write_exr(path("float.exr"), image).ok());
  const auto read = read_exr(path("half.exr"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  bool rounded = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float got = read->channel("R")->at(i);
    EXPECT_LE(std::abs(got - values[i]), values[i] / 2048) << i;
    rounded = rounded || got != values[i];
  }
  EXPECT_TRUE(rounded) << "the file holds floats";
  EXPECT_LT(fs_std::file_size(path("half.exr")), fs_std::file_size(path("float.exr")));
}

TEST_F(ImageIoTest, TheSameImageGivesTheSameBytes) {
  ExrImage image(50, 50);
  image.add_channel("R", wide_values(image.pixels()));
  ASSERT_TRUE(write_exr(path("a.exr"), image).ok());
  ASSERT_TRUE(write_exr(path("b.exr"), image).ok());
  EXPECT_EQ(contents(path("a.exr")), contents(path("b.exr")));
}

TEST_F(ImageIoTest, AFailedWriteSaysWhyAndLeavesTheOldFile) {
  const std::vector<std::uint32_t> pixels(4, 0xffffffffu);
  ExrImage image(2, 2);
  image.add_channel("R", {1, 2, 3, 4});
  for (const char* name : {"nowhere/a.png", "nowhere/a.exr"}) {
    const std::string file = path(name);
    const Status status = file.ends_with("png") ? write_png(file, 2, 2, pixels) : write_exr(file, image);
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().message, HasSubstr(file));
    EXPECT_THAT(status.error().message, HasSubstr("cannot be written"));
  }
  // A folder of that name: the partial file is whole, the rename fails.
  fs_std::create_directories(path("taken/inside"));
  EXPECT_FALSE(write_png(path("taken"), 2, 2, pixels).ok());
  EXPECT_FALSE(write_exr(path("taken"), image).ok());
  EXPECT_TRUE(fs_std::is_directory(path("taken/inside")));
  EXPECT_EQ(files_in_folder(), 1u) << "a partial file was left behind";
}

TEST_F(ImageIoTest, WritingAgainReplaces) {
  ExrImage first(2, 1), second(1, 1);
  first.add_channel("R", {1, 2});
  second.add_channel("G", {3});
  ASSERT_TRUE(write_exr(path("a.exr"), first).ok());
  ASSERT_TRUE(write_exr(path("a.exr"), second).ok());
  const auto read = read_exr(path("a.exr"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->channel("R"), nullptr);
  EXPECT_THAT(*read->channel("G"), ::testing::ElementsAre(3.0f));
}

TEST_F(ImageIoTest, DamagedExrIsRefusedWithItsName) {
  EXPECT_FALSE(read_exr(path("missing.exr")).ok());
  ExrImage image(64, 64);
  image.add_channel("R", wide_values(image.pixels()));
  ASSERT_TRUE(write_exr(path("a.exr"), image).ok());
  const Bytes whole = contents(path("a.exr"));
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
    store(path("cut.exr"), Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    const auto read = read_exr(path("cut.exr"));
    ASSERT_FALSE(read.ok()) << "of " << whole.size() << " bytes, " << size;
    EXPECT_THAT(read.error().message, HasSubstr(path("cut.exr")));
  }
  // The width that the header gives its data window, made so large that nothing could hold the pixels.
  const std::string key("dataWindow\0box2i\0", 17);
  Bytes huge = whole;
  const auto found = std::search(huge.begin(), huge.end(), key.begin(), key.end());
  ASSERT_NE(found, huge.end());
  const auto x_max = found + static_cast<std::ptrdiff_t>(key.size()) + 4 + 8;
  for (int i = 0; i < 3; ++i) *(x_max + i) = 0xff;
  store(path("huge.exr"), huge);
  EXPECT_FALSE(read_exr(path("huge.exr")).ok());
}

}  // namespace
}  // namespace fb::lab
