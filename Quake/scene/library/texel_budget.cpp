#include "scene/library/texel_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <utility>

#include "scene/library/asset_builder.h"

namespace fb::scene {
namespace {

constexpr std::size_t kSteps = 4096;  // of linear light: two sRGB bytes are nowhere nearer than 1 / 3295

std::uint8_t srgb_from_linear(float linear) {
  static const auto table = [] {
    std::array<std::uint8_t, kSteps + 1> values{};
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const float l = static_cast<float>(i) / static_cast<float>(kSteps);
      const float encoded = l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1.0f / 2.4f) - 0.055f;
      values[i] = static_cast<std::uint8_t>(std::lround(255.0f * std::min(encoded, 1.0f)));
    }
    return values;
  }();
  return table[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.0f, 1.0f) * static_cast<float>(kSteps)))];
}

using Four = std::array<const std::uint8_t*, 4>;

void mean_of_colors(const Four& from, std::uint8_t* to) {
  vec3 sum(0.0f);
  float weights = 0.0f, alpha = 0.0f;
  const bool clear = std::ranges::all_of(from, [](const std::uint8_t* texel) { return texel[3] == 0; });
  for (const std::uint8_t* texel : from) {
    const float weight = clear ? 1.0f : static_cast<float>(texel[3]);
    sum += weight * vec3(linear_from_srgb(texel[0]), linear_from_srgb(texel[1]), linear_from_srgb(texel[2]));
    weights += weight;
    alpha += static_cast<float>(texel[3]);
  }
  for (int i = 0; i < 3; ++i) to[i] = srgb_from_linear(sum[i] / weights);
  to[3] = static_cast<std::uint8_t>(std::lround(alpha / 4.0f));
}

void mean_of_bytes(const Four& from, std::uint8_t* to, std::size_t channels) {
  for (std::size_t i = 0; i < channels; ++i)
    to[i] = static_cast<std::uint8_t>((from[0][i] + from[1][i] + from[2][i] + from[3][i] + 2) / 4);
}

}  // namespace

std::uint64_t texel_bytes(const Image& image) { return (std::uint64_t{image.texels.size()} + 3) / 4 * 4; }

void halve(Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  const std::size_t size = texel_bytes(image.encoding);
  const std::size_t new_width = std::max<std::size_t>(width / 2, 1), new_height = std::max<std::size_t>(height / 2, 1);
  std::vector<std::uint8_t> texels(new_width * new_height * size);
  for (std::size_t y = 0; y < new_height; ++y) {
    for (std::size_t x = 0; x < new_width; ++x) {
      const auto at = [&](std::size_t dx, std::size_t dy) {
        const std::size_t column = std::min(2 * x + dx, width - 1), row = std::min(2 * y + dy, height - 1);
        return image.texels.data() + (row * width + column) * size;
      };
      const Four from{at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
      std::uint8_t* to = texels.data() + (y * new_width + x) * size;
      switch (image.encoding) {
        case ImageEncoding::kPalette:
          *to = *from[0];
          break;
        case ImageEncoding::kSrgba:
          mean_of_colors(from, to);
          break;
        case ImageEncoding::kLinearRgba:
        case ImageEncoding::kLinearGray:
          mean_of_bytes(from, to, size);
          break;
        case ImageEncoding::kWords:
          break;
      }
    }
  }
  image.texels = std::move(texels);
  image.width = static_cast<int>(new_width);
  image.height = static_cast<int>(new_height);
}

std::size_t halve_largest(std::vector<Image>& images, std::uint64_t most) {
  std::uint64_t bytes = 0;
  const auto smaller = [&](std::size_t a, std::size_t b) {
    const std::uint64_t x = texel_bytes(images[a]), y = texel_bytes(images[b]);
    return x != y ? x < y : a > b;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(smaller)> largest(smaller);
  for (std::size_t i = 0; i < images.size(); ++i) {
    bytes += texel_bytes(images[i]);
    if (images[i].encoding == ImageEncoding::kWords) continue;  // no picture
    if (images[i].width > 1 || images[i].height > 1) largest.push(i);
  }
  std::set<std::size_t> halved;
  while (bytes > most && !largest.empty()) {
    const std::size_t i = largest.top();
    largest.pop();
    bytes -= texel_bytes(images[i]);
    halve(images[i]);
    bytes += texel_bytes(images[i]);
    halved.insert(i);
    if (images[i].width > 1 || images[i].height > 1) largest.push(i);
  }
  return halved.size();
}

}  // namespace fb::scene
