// Shared by the image parsers. Internal to formats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/bytes.h"
#include "formats/image.h"

namespace fb::formats::detail {

// The error if an image of this size is refused; `offset` is that of the size in the file.
inline std::optional<Error> size_error(const ByteReader& reader, std::size_t offset, std::uint32_t width,
                                       std::uint32_t height) {
  if (width >= 1 && height >= 1 && width <= kMaxImageSize && height <= kMaxImageSize &&
      std::size_t{width} * height <= kMaxImagePixels) {
    return std::nullopt;
  }
  return reader.error_at(
      offset, "image of " + std::to_string(width) + " by " + std::to_string(height) + " texels is empty or too large");
}

}  // namespace fb::formats::detail
