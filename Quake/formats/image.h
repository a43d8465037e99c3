// Images in Quake's formats: palette indices, or RGBA from files beside the game data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::formats {

// 256 sRGB colours. Indices 224..255 glow ("fullbright"); index 255 is also transparent in formats that say so.
struct Palette {
  std::array<std::array<std::uint8_t, 3>, 256> rgb{};
};

// 8-bit indexed, row-major, top row first. width*height bytes.
struct IndexedImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> indices;
};

// 8 bits a channel, RGBA, row-major, top row first. 4*width*height bytes.
struct RgbaImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

constexpr int kMaxImageSize = 16384;                        // a side; larger is refused
constexpr std::size_t kMaxImagePixels = 8192ull * 8192ull;  // of an RGBA image; more is refused

// All of these refuse a bad file with file, offset and cause. They allocate pixels only if the file is long enough to
// hold them (for compressed files: at the best ratio that their coding allows).

// gfx/palette.lmp: 768 bytes.
Result<Palette> parse_palette(ByteView data, std::string_view name);
// *.lmp picture: i32 width, i32 height, indices. conchars has no header: see wad.h.
Result<IndexedImage> parse_lmp(ByteView data, std::string_view name);
// PCX (8-bit paletted with its own palette, and 24-bit), TGA (types 1, 2, 3, 9, 10, 11; 8 to 32 bits), PNG (libpng).
Result<RgbaImage> parse_pcx(ByteView data, std::string_view name);
Result<RgbaImage> parse_tga(ByteView data, std::string_view name);
Result<RgbaImage> parse_png(ByteView data, std::string_view name);
// Chooses by the name's extension: .pcx, .tga or .png in any case.
Result<RgbaImage> parse_image(ByteView data, std::string_view name);

}  // namespace fb::formats
