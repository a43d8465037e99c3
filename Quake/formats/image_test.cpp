// Images of each kind: what was written comes back, in every orientation and depth; damage is refused.
#include "formats/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/invariants.h"
#include "formats/test_bytes.h"
#include "formats/test_corruption.h"
#include "formats/test_files.h"
#include "formats/test_images.h"

namespace fb::formats {
namespace {

using ::testing::HasSubstr;
using testing::small_image;
using testing::TgaOptions;
using testing::write_pcx;
using testing::write_png;
using testing::write_tga;

template <typename Parse>
testing::Attempt image_attempt(Parse parse, const char* name) {
  return testing::attempt([parse, name](const Bytes& bytes) { return parse(bytes, name); },
                          [](const auto& image) { return testing::broken_image(image); });
}

Palette ramp() {
  Palette palette;
  for (std::size_t i = 0; i < 256; ++i) {
    palette.rgb[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 7};
  }
  return palette;
}

TEST(Palette, Reads768Bytes) {
  Bytes file;
  for (const auto& colour : ramp().rgb) file.insert(file.end(), colour.begin(), colour.end());
  const auto palette = parse_palette(file, "gfx/palette.lmp");
  ASSERT_TRUE(palette.ok());
  EXPECT_EQ(palette->rgb, ramp().rgb);
  file.pop_back();
  EXPECT_THAT(parse_palette(file, "gfx/palette.lmp").error().message, HasSubstr("gfx/palette.lmp: offset 767"));
}

TEST(Lmp, RoundTripsAndStandsDamage) {
  const Bytes file = testing::write_lmp(testing::small_picture());
  const auto image = parse_lmp(file, "gfx/x.lmp");
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(testing::write_lmp(*image), file);
  const auto attempt = image_attempt(parse_lmp, "gfx/x.lmp");
  testing::expect_refused_when_cut(attempt, file, "gfx/x.lmp");
  testing::expect_sound_when_damaged(attempt, file, "gfx/x.lmp");
}

TEST(Pcx, PalettedAndTrueColour) {
  IndexedImage indexed = testing::small_picture();
  for (std::uint8_t& index : indexed.indices) index = static_cast<std::uint8_t>(index + 190);  // across the run mark
  const Bytes paletted = write_pcx(indexed, ramp());
  const auto image = parse_pcx(paletted, "x.pcx");
  ASSERT_TRUE(image.ok()) << image.error().message;
  ASSERT_EQ(testing::broken_image(*image), "");
  for (std::size_t i = 0; i < indexed.indices.size(); ++i) {
    EXPECT_EQ(image->rgba[4 * i], indexed.indices[i]);
    EXPECT_EQ(image->rgba[4 * i + 1], 255 - indexed.indices[i]);
    EXPECT_EQ(image->rgba[4 * i + 3], 255);
  }
  const Bytes coloured = write_pcx(small_image(false));
  const auto true_colour = parse_pcx(coloured, "x.pcx");
  ASSERT_TRUE(true_colour.ok()) << true_colour.error().message;
  EXPECT_EQ(true_colour->rgba, small_image(false).rgba);

  const auto attempt = image_attempt(parse_pcx, "x.pcx");
  testing::expect_refused_when_cut(attempt, coloured, "x.pcx");
  testing::expect_sound_when_damaged(attempt, coloured, "x.pcx");
  testing::expect_sound_when_damaged(attempt, paletted, "x.pcx");
  for (std::size_t length = 0; length < paletted.size(); ++length) {
    const Bytes cut(paletted.begin(), paletted.begin() + static_cast<std::ptrdiff_t>(length));
    testing::expect_refused(attempt, cut, "x.pcx");
  }
}

// Runs of all lengths, also those that pass 63 and those that end a row.
TEST(Pcx, LongRuns) {
  IndexedImage indexed{200, 2, std::vector<std::uint8_t>(400, 5)};
  for (std::size_t i = 40; i < 50; ++i) indexed.indices[i] = 250;
  const auto image = parse_pcx(write_pcx(indexed, ramp()), "x.pcx");
  ASSERT_TRUE(image.ok()) << image.error().message;
  for (std::size_t i = 0; i < 400; ++i) ASSERT_EQ(image->rgba[4 * i], indexed.indices[i]) << i;
}

TEST(Tga, EveryKindAndOrientation) {
  const RgbaImage with_alpha = small_image(true), opaque = small_image(false);
  RgbaImage grey = opaque, grey_alpha = with_alpha, five_bits = opaque;
  for (std::size_t i = 0; i < grey.rgba.size(); i += 4) {
    grey.rgba[i + 1] = grey.rgba[i + 2] = grey.rgba[i];
    grey_alpha.rgba[i + 1] = grey_alpha.rgba[i + 2] = grey_alpha.rgba[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t value = five_bits.rgba[i + k] >> 3u;
      five_bits.rgba[i + k] = static_cast<std::uint8_t>(value << 3u | value >> 2u);
    }
  }
  struct Kind {
    std::uint32_t type, bits;
    const RgbaImage& source;
    const RgbaImage& expected;
  };
  const std::array<Kind, 7> kinds = {{{2, 32, with_alpha, with_alpha},
                                      {2, 24, with_alpha, opaque},
                                      {2, 16, opaque, five_bits},
                                      {1, 8, opaque, opaque},
                                      {1, 16, opaque, opaque},
                                      {3, 8, grey, grey},
                                      {3, 16, grey_alpha, grey_alpha}}};
  for (const Kind& kind : kinds) {
    for (const std::uint32_t packed : {0u, 8u}) {
      for (const int turn : {0, 1, 2, 3}) {
        const Bytes file =
            write_tga(kind.source, {kind.type + packed, kind.bits, (turn & 1) != 0, (turn & 2) != 0, "comment"});
        const auto image = parse_tga(file, "x.tga");
        ASSERT_TRUE(image.ok()) << image.error().message;
        EXPECT_EQ(image->width, 5);
        EXPECT_EQ(image->rgba, kind.expected.rgba) << kind.type + packed << " " << kind.bits << " " << turn;
      }
    }
  }
}

TEST(Tga, StandsDamage) {
  const auto attempt = image_attempt(parse_tga, "x.tga");
  for (const std::uint32_t type : {1u, 2u, 3u, 9u, 10u, 11u}) {
    const Bytes file = write_tga(small_image(true), {type, (type & 3u) == 2 ? 24u : 8u, false, false, ""});
    testing::expect_refused_when_cut(attempt, file, "x.tga");
    testing::expect_sound_when_damaged(attempt, file, "x.tga");
  }
}

TEST(Tga, ContradictionsAreRefused) {
  Bytes file = write_tga(small_image(true), {1, 8, false, false, ""});
  file.back() = 200;  // the map has colours 3 to 17
  EXPECT_THAT(parse_tga(file, "x.tga").error().message, HasSubstr("colour map of 15"));
  file = write_tga(small_image(true), {2, 32, false, false, ""});
  file[2] = 7;
  EXPECT_THAT(parse_tga(file, "x.tga").error().message, HasSubstr("unknown type 7"));
  file[2] = 2;
  file[16] = 12;
  EXPECT_THAT(parse_tga(file, "x.tga").error().message, HasSubstr("12 bits"));
  file[12] = file[13] = 0;
  file[16] = 32;
  EXPECT_THAT(parse_tga(file, "x.tga").error().message, HasSubstr("empty or too large"));
}

TEST(Png, RoundTripsAndStandsDamage) {
  for (const bool alpha : {false, true}) {
    const Bytes file = write_png(small_image(alpha), alpha);
    ASSERT_FALSE(file.empty());
    const auto image = parse_png(file, "x.png");
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(image->rgba, small_image(alpha).rgba);
    const auto attempt = image_attempt(parse_png, "x.png");
    testing::expect_refused_when_cut(attempt, file, "x.png");
    testing::expect_sound_when_damaged(attempt, file, "x.png");
  }
}

// A few bytes that claim a gigabyte of pixels are refused before anything is allocated.
TEST(Images, HugeClaimsAreRefused) {
  testing::ByteWriter png{write_png(small_image(false), false)};
  png.patch_u32(16, 0x00200000u);  // 8192, big-endian
  png.patch_u32(20, 0x00200000u);
  EXPECT_THAT(parse_png(png.out, "x.png").error().message, HasSubstr("too short for its size"));
  testing::ByteWriter tga{write_tga(small_image(true), {10, 32, false, false, ""})};
  tga.patch_u32(12, 0x20002000u);
  EXPECT_THAT(parse_tga(tga.out, "x.tga").error().message, HasSubstr("before its last pixel"));
  tga.patch_u32(12, 0x40004000u);
  EXPECT_THAT(parse_tga(tga.out, "x.tga").error().message, HasSubstr("too large"));
  testing::ByteWriter pcx{write_pcx(small_image(false))};
  pcx.patch_u32(8, 0x1fff1fffu);
  pcx.out[66] = 0xff;
  pcx.out[67] = 0x3f;
  EXPECT_THAT(parse_pcx(pcx.out, "x.pcx").error().message, HasSubstr("ends early"));
}

TEST(Images, ChosenByExtension) {
  EXPECT_TRUE(parse_image(write_png(small_image(true), true), "a/b.PNG").ok());
  EXPECT_TRUE(parse_image(write_tga(small_image(true), {}), "a/b.tga").ok());
  EXPECT_TRUE(parse_image(write_pcx(small_image(true)), "a/b.Pcx").ok());
  EXPECT_THAT(parse_image({}, "a/b.gif").error().message, HasSubstr("a/b.gif"));
  EXPECT_FALSE(parse_image({}, "noextension").ok());
}

}  // namespace
}  // namespace fb::formats
