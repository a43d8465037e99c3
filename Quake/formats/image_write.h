// Pictures as files.
#pragma once

#include <cstdint>
#include <span>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::formats {

enum class PngAlpha { kIgnored, kKept };  // the highest byte: RGB or RGBA

// An 8-bit PNG. pixels: width*height, red in the lowest byte, then green, blue, alpha. sRGB, as a screen shows it.
// Fails where libpng does, for want of memory.
Result<Bytes> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                         PngAlpha alpha = PngAlpha::kIgnored);

}  // namespace fb::formats
