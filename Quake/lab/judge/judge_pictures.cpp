#include "lab/judge/judge_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "base/check.h"
#include "lab/image_io.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kGap = 2;  // pixels between pictures

std::vector<std::uint32_t> packed(const Picture& shown) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(shown.pixels.size());
  for (const vec3& p : shown.pixels) {
    std::uint32_t value = 0;
    for (int c = 0; c < 3; ++c)
      value |= static_cast<std::uint32_t>(std::lround(255 * std::clamp(p[c], 0.0f, 1.0f))) << (8 * c);
    pixels.push_back(value);
  }
  return pixels;
}

// Pictures of one size in a grid of two rows.
class Sheet {
 public:
  Sheet(std::uint32_t width, std::uint32_t height, std::size_t columns)
      : width_(width),
        height_(height),
        whole_(static_cast<std::uint32_t>(columns) * (width + kGap) - kGap),
        pixels_(std::size_t{whole_} * (2 * height + kGap), 0x404040u) {}
  void put(std::size_t column, std::uint32_t row, const std::vector<std::uint32_t>& pixels) {
    FB_CHECK_EQ(pixels.size(), std::size_t{width_} * height_);
    for (std::uint32_t y = 0; y < height_; ++y) {
      const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * width_);
      const std::size_t to = (std::size_t{row} * (height_ + kGap) + y) * whole_ + column * (width_ + kGap);
      std::copy(from, from + width_, pixels_.begin() + static_cast<std::ptrdiff_t>(to));
    }
  }
  Status write(const std::string& path) const { return write_png(path, whole_, 2 * height_ + kGap, pixels_); }

 private:
  std::uint32_t width_, height_, whole_;
  std::vector<std::uint32_t> pixels_;
};

}  // namespace

Status write_side_by_side(const std::string& folder, const std::string& name, const Picture& reference,
                          const std::vector<bool>& silhouettes, const std::vector<Beside>& columns) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{fmt::format("{}: {}", folder, failed.message())};
  Sheet sheet(reference.width, reference.height, columns.size() + 1);
  sheet.put(0, 0, packed(reference));
  std::vector<std::uint32_t> edges(silhouettes.size());
  std::transform(silhouettes.begin(), silhouettes.end(), edges.begin(),
                 [](bool edge) { return edge ? 0xffffffu : 0u; });
  sheet.put(0, 1, edges);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    sheet.put(i + 1, 0, packed(columns[i].shown));
    sheet.put(i + 1, 1, heat_colors(columns[i].flip));
  }
  return sheet.write(fmt::format("{}/{}.png", folder, name));
}

}  // namespace fb::lab
