#include "formats/image_write.h"

#include <png.h>

#include <string>

#include "base/check.h"

namespace fb::formats {

Result<Bytes> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                         PngAlpha alpha) {
  FB_CHECK_EQ(pixels.size(), std::size_t{width} * height);
  const int channels = alpha == PngAlpha::kKept ? 4 : 3;
  Bytes rgb;
  rgb.reserve(pixels.size() * static_cast<std::size_t>(channels));
  for (const std::uint32_t pixel : pixels) {
    for (int shift = 0; shift < 8 * channels; shift += 8) rgb.push_back(static_cast<std::uint8_t>(pixel >> shift));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = alpha == PngAlpha::kKept ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  // libpng frees its own state when a call fails; the first call only asks for a bound of the size.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  Bytes file(size);
  if (!png_image_write_to_memory(&image, file.data(), &size, 0, rgb.data(), 0, nullptr))
    return Error{std::string(image.message)};
  file.resize(size);
  return file;
}

}  // namespace fb::formats
