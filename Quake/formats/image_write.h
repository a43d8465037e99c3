// Pictures as files.
#pragma once

#include <cstdint>
#include <span>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::formats {

// An 8-bit RGB PNG. pixels: width*height, red in the lowest byte, then green, blue; the highest is ignored. sRGB, as a
// screen shows it. Fails where libpng does, for want of memory.
Result<Bytes> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels);

}  // namespace fb::formats
