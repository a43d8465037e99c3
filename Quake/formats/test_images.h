// Small valid images made in code, for tests and for the fuzzers' seeds: PCX and TGA by hand, PNG by libpng.
#pragma once

#include <png.h>

#include <array>
#include <cstdint>
#include <vector>

#include "formats/image.h"
#include "formats/test_bytes.h"

namespace fb::formats::testing {

// Five by three pixels of different colours, with alpha.
inline RgbaImage small_image(bool with_alpha) {
  RgbaImage image{5, 3, {}};
  for (std::uint32_t i = 0; i < 15; ++i) {
    image.rgba.push_back(static_cast<std::uint8_t>(17 * i));
    image.rgba.push_back(static_cast<std::uint8_t>(255 - 16 * i));
    image.rgba.push_back(static_cast<std::uint8_t>(40 + i));
    image.rgba.push_back(static_cast<std::uint8_t>(with_alpha ? 100 + i : 255));
  }
  return image;
}

// One run or literal for each byte: values of 0xc0 and more need a run of one.
inline void pack_pcx_row(ByteWriter& w, const std::vector<std::uint8_t>& row) {
  for (std::size_t i = 0; i < row.size();) {
    std::size_t run = 1;
    while (i + run < row.size() && run < 63 && row[i + run] == row[i]) ++run;
    if (run > 1 || row[i] >= 0xc0) w.u8(0xc0u + static_cast<std::uint32_t>(run));
    w.u8(row[i]);
    i += run;
  }
}

inline void pcx_header(ByteWriter& w, int width, int height, std::uint32_t planes, std::uint32_t row_bytes) {
  w.u8(10);
  w.u8(5);
  w.u8(1);
  w.u8(8);
  w.u32(0);
  w.u16(static_cast<std::uint32_t>(width - 1));
  w.u16(static_cast<std::uint32_t>(height - 1));
  w.text("", 4 + 48 + 1);
  w.u8(planes);
  w.u16(row_bytes);
  w.text("", 128 - w.out.size());
}

// Rows are padded to an even number of bytes, as the format requires.
inline Bytes write_pcx(const IndexedImage& image, const Palette& palette) {
  ByteWriter w;
  const auto width = static_cast<std::size_t>(image.width);
  pcx_header(w, image.width, image.height, 1, static_cast<std::uint32_t>(width + width % 2));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    std::vector<std::uint8_t> row(image.indices.begin() + static_cast<std::ptrdiff_t>(y * width),
                                  image.indices.begin() + static_cast<std::ptrdiff_t>((y + 1) * width));
    row.resize(width + width % 2);
    pack_pcx_row(w, row);
  }
  w.u8(0x0c);
  for (const auto& colour : palette.rgb) w.bytes(colour);
  return w.out;
}
inline Bytes write_pcx(const RgbaImage& image) {
  ByteWriter w;
  const auto width = static_cast<std::size_t>(image.width);
  pcx_header(w, image.width, image.height, 3, static_cast<std::uint32_t>(width + width % 2));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      std::vector<std::uint8_t> row(width + width % 2);
      for (std::size_t x = 0; x < width; ++x) row[x] = image.rgba[4 * (y * width + x) + channel];
      pack_pcx_row(w, row);
    }
  }
  return w.out;
}

struct TgaOptions {
  std::uint32_t type = 2;  // 1, 2, 3, and 9, 10, 11 for packets
  std::uint32_t bits = 32;
  bool top_down = false, right_to_left = false;
  std::string id;
};

// Colour-mapped images get a 24-bit map of all their pixels; grey ones use red. 16-bit colours keep five bits.
inline Bytes write_tga(const RgbaImage& image, const TgaOptions& options) {
  const auto width = static_cast<std::uint32_t>(image.width), height = static_cast<std::uint32_t>(image.height);
  const std::uint32_t kind = options.type & 7u;
  constexpr std::uint32_t kFirstColour = 3;
  ByteWriter w;
  w.u8(static_cast<std::uint32_t>(options.id.size()));
  w.u8(kind == 1 ? 1 : 0);
  w.u8(options.type);
  w.u16(kind == 1 ? kFirstColour : 0);
  w.u16(kind == 1 ? width * height : 0);
  w.u8(kind == 1 ? 24 : 0);
  w.u32(0);
  w.u16(width);
  w.u16(height);
  w.u8(options.bits);
  w.u8((options.top_down ? 0x20u : 0) | (options.right_to_left ? 0x10u : 0) | (options.bits == 32 ? 8u : 0));
  w.text(options.id, options.id.size());
  if (kind == 1) {
    for (std::uint32_t i = 0; i < width * height; ++i) {
      for (const std::uint32_t channel : {2u, 1u, 0u}) w.u8(image.rgba[4 * i + channel]);
    }
  }
  const auto pixel = [&](std::uint32_t n) {
    std::uint32_t x = n % width, y = n / width;
    if (!options.top_down) y = height - 1 - y;
    if (options.right_to_left) x = width - 1 - x;
    const std::uint32_t i = y * width + x;
    const std::uint8_t* rgba = image.rgba.data() + std::size_t{4} * i;
    if (kind == 1) {
      options.bits == 16 ? w.u16(i + kFirstColour) : w.u8(i + kFirstColour);
    } else if (kind == 3) {
      w.u8(rgba[0]);
      if (options.bits == 16) w.u8(rgba[3]);
    } else if (options.bits <= 16) {
      w.u16((rgba[0] >> 3u) << 10u | (rgba[1] >> 3u) << 5u | rgba[2] >> 3u);
    } else {
      w.u8(rgba[2]);
      w.u8(rgba[1]);
      w.u8(rgba[0]);
      if (options.bits == 32) w.u8(rgba[3]);
    }
  };
  // Packets: two literal pixels, then a run of one, and so on; they cross the ends of rows.
  for (std::uint32_t n = 0; n < width * height; ++n) {
    if (options.type >= 8 && n % 3 == 0) w.u8(n + 1 < width * height ? 1 : 0);
    if (options.type >= 8 && n % 3 == 2) w.u8(0x80);
    pixel(n);
  }
  return w.out;
}

inline Bytes write_png(const RgbaImage& image, bool with_alpha) {
  png_image encoder{};
  encoder.version = PNG_IMAGE_VERSION;
  encoder.width = static_cast<std::uint32_t>(image.width);
  encoder.height = static_cast<std::uint32_t>(image.height);
  encoder.format = with_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (with_alpha || i % 4 != 3) pixels.push_back(image.rgba[i]);
  }
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&encoder, nullptr, &size, 0, pixels.data(), 0, nullptr) == 0) return {};
  Bytes out(size);
  if (png_image_write_to_memory(&encoder, out.data(), &size, 0, pixels.data(), 0, nullptr) == 0) return {};
  out.resize(size);
  return out;
}

}  // namespace fb::formats::testing
