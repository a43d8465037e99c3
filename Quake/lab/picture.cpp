#include "lab/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/image.h"
#include "fs/file.h"
#include "lab/image_io.h"
#include "scene/library/asset_builder.h"

namespace fb::lab {
namespace {

Result<std::vector<vec3>> colors(const ExrImage& image, const std::string& path, const std::string& layer) {
  std::vector<vec3> out(image.pixels());
  for (int c = 0; c < 3; ++c) {
    const std::string name = layer + "RGB"[c];
    const auto* plane = image.channel(name);
    if (plane == nullptr) return Error{fmt::format("{}: has no channel {}", path, name)};
    for (std::size_t i = 0; i < out.size(); ++i) out[i][c] = (*plane)[i];
  }
  return out;
}

}  // namespace

Status check_reference(const Reference& reference, const std::string& path) {
  if (!std::ranges::all_of(reference.mean.pixels, finite))
    return Error{fmt::format("{}: holds values that are not finite; a reference has none", path)};
  const auto is_variance = [](const vec3& v) { return finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0; };
  if (!std::ranges::all_of(reference.variance, is_variance))
    return Error{
        fmt::format("{}: variance.R, .G or .B hold values below zero or not finite; leave these channels out "
                    "where the variance is not known",
                    path)};
  return ok_status();
}

Result<ExrPicture> read_exr_picture(const std::string& path) {
  const auto image = read_exr(path);
  if (!image) return image.error();
  ExrPicture picture;
  auto mean = colors(*image, path, "");
  if (!mean) return mean.error();
  picture.content.mean = Picture{image->width(), image->height(), std::move(*mean)};
  if (image->channel("variance.R") != nullptr) {
    auto variance = colors(*image, path, "variance.");
    if (!variance) return variance.error();
    picture.content.variance = std::move(*variance);
  }
  picture.texts = image->texts();
  return picture;
}

Result<Picture> read_png_picture(const std::string& path) {
  const auto data = fs::read_whole_file(path);
  if (!data) return data.error();
  const auto image = formats::parse_png(*data, path);
  if (!image) return image.error();
  Picture picture{static_cast<std::uint32_t>(image->width), static_cast<std::uint32_t>(image->height), {}};
  picture.pixels.reserve(image->rgba.size() / 4);
  for (std::size_t i = 0; i + 3 < image->rgba.size(); i += 4)
    picture.pixels.push_back(vec3(image->rgba[i], image->rgba[i + 1], image->rgba[i + 2]) / 255.0f);
  return picture;
}

Picture picture_of(const std::vector<vec4>& linear, uvec2 size) {
  Picture picture{size.x, size.y, std::vector<vec3>(linear.size())};
  std::transform(linear.begin(), linear.end(), picture.pixels.begin(), [](const vec4& p) { return vec3(p); });
  return picture;
}

Picture decoded(const Picture& srgb) {
  Picture linear = srgb;
  for (vec3& p : linear.pixels)
    for (int c = 0; c < 3; ++c) p[c] = scene::linear_from_srgb(p[c]);
  return linear;
}

std::vector<std::uint32_t> heat_colors(const std::vector<float>& values) {
  static const std::array<vec3, 6> stops{vec3(0, 0, 0),      vec3(60, 15, 110),  vec3(150, 40, 105),
                                         vec3(235, 100, 45), vec3(250, 195, 60), vec3(255, 255, 240)};
  std::vector<std::uint32_t> pixels;
  pixels.reserve(values.size());
  for (const float value : values) {
    const float at = std::clamp(value, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const vec3 color = glm::mix(stops[below], stops[below + 1], at - static_cast<float>(below));
    std::uint32_t packed = 0;
    for (int c = 0; c < 3; ++c) packed |= static_cast<std::uint32_t>(std::lround(color[c])) << (8 * c);
    pixels.push_back(packed);
  }
  return pixels;
}

Status write_heat_map(const std::string& path, std::uint32_t width, std::uint32_t height,
                      const std::vector<float>& values) {
  return write_png(path, width, height, heat_colors(values));
}

}  // namespace fb::lab
