// Outlier removal (after Zirr 2018): samples that are much brighter than what is common about their pixel count less.
// It looks at what samples are worth alone, not at their densities: what Fan 2025 is compared and combined with.
//
// Samples are sorted into layers of brightness, each kLayerRatio times as bright as the one before. A sample between
// two of them is split so that neither its light nor its number changes. A layer counts in full where a pixel and its
// eight neighbours have `enough` samples of its brightness, of the layers next to it as well, and in proportion where
// there are fewer. These layers and their one threshold are our own choice. What is dimmer than the first layer, far
// below the picture's mean, always counts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"

namespace fb::render {

inline constexpr double kLayerRatio = 8;

// A picture's samples, one a pixel in each frame.
class SingleSamples {
 public:
  void clear() { *this = SingleSamples(); }
  void add(std::span<const vec4> frame);  // radiance, row by row
  // Frames so far.
  std::uint32_t count() const { return static_cast<std::uint32_t>(frames_.size()); }
  // Adds to what a pixel's sample is worth, times the number of all samples.
  void shift(std::uint32_t frame, std::size_t pixel, const glm::dvec3& by) { frames_[frame][pixel] += vec3(by); }
  // Their mean without outliers. `enough`: above 0.
  std::vector<vec4> without_outliers(uvec2 size, double enough) const;

  void save(Bytes& state) const;
  // False, and all forgotten: the bytes are not whole, or of another number of pixels.
  bool load(ByteReader& state, std::size_t pixels);

 private:
  std::vector<std::vector<vec3>> frames_;
};

}  // namespace fb::render
