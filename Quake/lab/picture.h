// Picture: colours in memory, what the metrics compare; Reference: one whose own uncertainty may be known. And how both
// come from files.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"

namespace fb::lab {

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<vec3> pixels;  // row-major, top row first; linear Rec.709 unless something else is said
  bool same_size(const Picture& other) const { return width == other.width && height == other.height; }
};

inline bool finite(const vec3& pixel) {
  return std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z);
}

struct Reference {
  Picture mean;
  std::vector<vec3> variance;  // of each pixel's mean; empty: unknown
};

// Fails, naming `path`, where a value is not finite or a variance is none.
Status check_reference(const Reference& reference, const std::string& path);

// EXR: channels R, G, B, and variance.R, .G, .B where it has them; `text` are its lines of text.
struct ExrPicture {
  Reference content;
  std::map<std::string, std::string> texts;
};
Result<ExrPicture> read_exr_picture(const std::string& path);
// PNG: sRGB as stored, 0 to 1; alpha is ignored.
Result<Picture> read_png_picture(const std::string& path);
// Of a renderer's image; its fourth component is left out.
Picture picture_of(const std::vector<vec4>& linear, uvec2 size);
// From sRGB as stored to linear.
Picture decoded(const Picture& srgb);

// Values of 0 to 1 as colours from black over violet and orange to white, red in the lowest byte.
std::vector<std::uint32_t> heat_colors(const std::vector<float>& values);
Status write_heat_map(const std::string& path, std::uint32_t width, std::uint32_t height,
                      const std::vector<float>& values);

}  // namespace fb::lab
