#include "render/techniques/outlier_removal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/techniques/iteration_state.h"
#include "shared/color.h"

namespace fb::render {
namespace {

constexpr std::size_t kLayers = 16;
constexpr double kFirstLayer = 1.0 / 512;  // of the picture's mean luminance

double luminance_of(const glm::dvec3& color) { return std::max(shared::luminance(vec3(color)), 0.0f); }

// Two layers, the second above the first, and the first one's share of a sample's light.
struct LayerSplit {
  std::size_t lower = 0;
  double share = 1;
};
// `brightness`: over the first layer's. The share a solves a / lower + (1 - a) / upper = 1 / brightness: the parts of
// the light stand for one sample together.
LayerSplit split_of(double brightness) {
  LayerSplit split;
  double lower = 1;
  while (brightness > lower * kLayerRatio && split.lower + 2 < kLayers) {
    lower *= kLayerRatio;
    ++split.lower;
  }
  if (brightness > lower) {
    const double upper = lower * kLayerRatio;
    split.share = std::max((1 / brightness - 1 / upper) / (1 / lower - 1 / upper), 0.0);
  }
  return split;
}

}  // namespace

void SingleSamples::add(std::span<const vec4> frame) {
  auto& colors = frames_.emplace_back();
  colors.reserve(frame.size());
  for (const vec4& pixel : frame) colors.emplace_back(pixel.x, pixel.y, pixel.z);
}

std::vector<vec4> SingleSamples::without_outliers(uvec2 size, double enough) const {
  const std::size_t pixels = std::size_t{size.x} * size.y;
  std::vector<vec4> picture(pixels, vec4(0.0f));
  double mean = 0;
  for (const auto& frame : frames_)
    for (const vec3& color : frame) mean += luminance_of(glm::dvec3(color));
  if (!(mean > 0)) return picture;
  mean /= static_cast<double>(pixels * frames_.size());
  const double first = kFirstLayer * mean;

  using Layers = std::array<glm::dvec3, kLayers>;
  std::vector<Layers> light(pixels, Layers{});
  for (const auto& frame : frames_) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const glm::dvec3 color(frame[i]);
      const LayerSplit split = split_of(luminance_of(color) / first);
      light[i][split.lower] += split.share * color;
      light[i][split.lower + 1] += (1 - split.share) * color;
    }
  }
  // Luminance of a layer of 3 x 3 pixels, fewer at an edge.
  const auto about = [&](std::uint32_t x, std::uint32_t y, std::size_t layer) {
    double sum = 0;
    for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, size.y - 1); ++v)
      for (std::uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, size.x - 1); ++u)
        sum += luminance_of(light[std::size_t{v} * size.x + u][layer]);
    return sum;
  };
  for (std::uint32_t y = 0; y < size.y; ++y) {
    for (std::uint32_t x = 0; x < size.x; ++x) {
      const std::size_t at = std::size_t{y} * size.x + x;
      glm::dvec3 sum = light[at][0];
      double brightness = first;
      for (std::size_t layer = 1; layer < kLayers; ++layer) {
        brightness *= kLayerRatio;
        if (light[at][layer] == glm::dvec3(0.0)) continue;
        double near = about(x, y, layer - 1) + about(x, y, layer);
        if (layer + 1 < kLayers) near += about(x, y, layer + 1);
        sum += light[at][layer] * std::min(near / brightness / enough, 1.0);
      }
      picture[at] = vec4(vec3(sum / static_cast<double>(frames_.size())), 0.0f);
    }
  }
  return picture;
}

void SingleSamples::save(Bytes& state) const {
  put_value(state, std::uint64_t{frames_.size()});
  for (const auto& frame : frames_) put_array(state, frame);
}
bool SingleSamples::load(ByteReader& state, std::size_t pixels) {
  clear();
  SingleSamples read;
  std::uint64_t frames = 0;
  if (!take_value(state, frames) || frames > state.remaining()) return false;
  for (std::uint64_t i = 0; i < frames; ++i) {
    auto& frame = read.frames_.emplace_back();
    if (!take_array(state, frame) || frame.size() != pixels) return false;
  }
  *this = std::move(read);
  return true;
}

}  // namespace fb::render
