#include "host/game/save_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "formats/image_write.h"
#include "ui/menu/facts.h"

namespace fb::host {
namespace {

using ui::menu::kSavePictureHeight;
using ui::menu::kSavePictureWidth;

constexpr std::size_t kMostPictureBytes = 1u << 20u;  // ours are at most a tenth
constexpr std::uint32_t kWide = kSavePictureWidth, kHigh = kSavePictureHeight;

// The part of `length` that pixel `index` of `count` covers, at least one.
std::array<std::uint32_t, 2> covered(std::uint32_t index, std::uint32_t count, std::uint32_t length) {
  const std::uint32_t begin = index * length / count;
  return {begin, std::max(begin + 1, (index + 1) * length / count)};
}

}  // namespace

std::vector<std::uint32_t> shrink_to_save_picture(std::span<const std::uint32_t> pixels, uvec2 size) {
  FB_CHECK_EQ(pixels.size(), std::size_t{size.x} * size.y);
  FB_CHECK(size.x > 0 && size.y > 0);
  const std::uint32_t width = std::clamp(size.y * kWide / kHigh, 1u, size.x);
  const std::uint32_t height = std::clamp(size.x * kHigh / kWide, 1u, size.y);
  const std::uint32_t left = (size.x - width) / 2, top = (size.y - height) / 2;
  std::vector<std::uint32_t> small;
  small.reserve(std::size_t{kWide} * kHigh);
  for (std::uint32_t row = 0; row < kHigh; ++row) {
    const auto [from_y, to_y] = covered(row, kHigh, height);
    for (std::uint32_t column = 0; column < kWide; ++column) {
      const auto [from_x, to_x] = covered(column, kWide, width);
      std::array<std::uint32_t, 3> sums{};
      for (std::uint32_t y = from_y; y < to_y; ++y) {
        for (std::uint32_t x = from_x; x < to_x; ++x) {
          const std::uint32_t pixel = pixels[std::size_t{top + y} * size.x + left + x];
          for (std::uint32_t c = 0; c < 3; ++c) sums[c] += pixel >> (8 * c) & 255u;
        }
      }
      const std::uint32_t count = (to_x - from_x) * (to_y - from_y);
      std::uint32_t mean = 0xff000000u;
      for (std::uint32_t c = 0; c < 3; ++c) mean |= (sums[c] + count / 2) / count << (8 * c);
      small.push_back(mean);
    }
  }
  return small;
}

Status write_save_picture(const fs::FileSystem& files, const std::string& save, std::span<const std::uint32_t> pixels,
                          uvec2 size) {
  const std::string name = save + ".png";
  const auto png = formats::encode_png(kWide, kHigh, shrink_to_save_picture(pixels, size));
  if (!png) return Error{fmt::format("{}: cannot be written: {}", name, png.error().message)};
  return files.write(name, *png);
}

std::optional<formats::RgbaImage> read_save_picture(const fs::FileSystem& files, const std::string& save) {
  const std::string name = save + ".png";
  const auto data = files.read_own(name);
  if (!data || data->size() > kMostPictureBytes) return std::nullopt;
  auto image = formats::parse_png(*data, name);
  if (!image || image->width != kSavePictureWidth || image->height != kSavePictureHeight) return std::nullopt;
  return *std::move(image);
}

}  // namespace fb::host
