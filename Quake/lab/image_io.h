// Picture files of the laboratory: 8-bit PNG for eyes, OpenEXR for numbers. A file appears under its name only when it
// is whole (fs/temporary_file.h).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"

namespace fb::lab {

// Named planes of floats, row-major, top row first. Radiance is linear Rec.709 in "R", "G", "B"; whatever belongs to it
// has a layer's name before it: "variance.R" (variance of the mean), "albedo.R", "normal.X"; "Z" is depth.
class ExrImage {
 public:
  ExrImage(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::size_t pixels() const { return std::size_t{width_} * height_; }

  // values: width*height of them. The same name again replaces the plane.
  void add_channel(const std::string& name, std::vector<float> values);
  // Colours as prefix + "R", "G" and "B".
  void add_colors(const std::string& prefix, std::span<const vec3> colors);
  const std::vector<float>* channel(const std::string& name) const;  // null if there is none
  const std::map<std::string, std::vector<float>>& channels() const { return channels_; }

  // A line of text that travels with the picture, e.g. "fullbright.command". The same name again replaces it.
  void set_text(const std::string& name, std::string value) { texts_[name] = std::move(value); }
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  std::uint32_t width_, height_;
  std::map<std::string, std::vector<float>> channels_;
  std::map<std::string, std::string> texts_;
};

enum class ExrPixels {
  kFloat,  // exact
  kHalf,   // 11 bits of precision, infinity from 65520 on: for pictures, not for references
};

constexpr std::uint64_t kMaxExrValues = std::uint64_t{1} << 28;  // over all channels of a file that is read: 1 GiB

// All of them fail with the file and the cause.

// pixels: width*height, red in the lowest byte, then green, blue; the highest is ignored. sRGB, as a screen shows it.
Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
                 std::span<const std::uint32_t> pixels);
// Lossless (ZIP of 16 lines); the same image gives the same bytes.
Status write_exr(const std::string& path, const ExrImage& image, ExrPixels kind = ExrPixels::kFloat);
// Any scan-line or tiled EXR of one part without subsampled channels; halves and integers become floats.
Result<ExrImage> read_exr(const std::string& path);

}  // namespace fb::lab
