#include "scene/library/lightmaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "scene/library/asset_builder.h"
#include "shared/tone.h"

namespace fb::scene {
namespace {

constexpr float kLuxelUnits = 16.0f;  // of the texture's axes
constexpr float kPainted = 128.0f;    // the value that shows a texture as it was painted
constexpr float kDisplayGamma = 2.2f;
constexpr float kLeastReflectance = 0.003f;  // darker textures stay black on displays in any light
constexpr std::size_t kDecoupledBytes = 40;
constexpr float kMostAxis = 1e6f, kMostOffset = 1e12f;  // luxels a unit, luxels: likewise
constexpr int kMostLuxels = 4096;                       // on a side; more comes from a damaged file

template <typename T>
T read(ByteView bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

ByteView bspx_lump(const formats::Bsp& bsp, std::string_view name) {
  for (const auto& [lump, bytes] : bsp.bspx)
    if (lump == name) return bytes;
  return {};
}

float encoded(float linear) { return shared::srgb_from_linear(vec3(linear)).x; }

bool is_sane(const vec4& axis) {
  const auto fits = [](float x, float most) { return std::fabs(x) <= most; };  // false of what is not a number
  return fits(axis.x, kMostAxis) && fits(axis.y, kMostAxis) && fits(axis.z, kMostAxis) && fits(axis.w, kMostOffset);
}

bool has_place(const Lightmaps::Face& face) {
  return face.width > 0 && face.height > 0 && face.width <= kMostLuxels && face.height <= kMostLuxels &&
         is_sane(face.axes[0]) && is_sane(face.axes[1]);
}

// What the lump says of a face's luxels, and where they begin; negative: it has none.
std::int64_t read_decoupled(ByteView lump, std::size_t number, Lightmaps::Face& face) {
  const std::size_t at = number * kDecoupledBytes;
  face.width = read<std::uint16_t>(lump, at);
  face.height = read<std::uint16_t>(lump, at + 2);
  for (std::size_t a = 0; a < 2; ++a)
    for (int c = 0; c < 4; ++c) face.axes[a][c] = read<float>(lump, at + 8 + 16 * a + 4 * static_cast<std::size_t>(c));
  return read<std::int32_t>(lump, at + 4);
}

// Some face has a place for light.
bool makes_sense(ByteView lump, std::size_t faces) {
  for (std::size_t i = 0; i < faces; ++i) {
    Lightmaps::Face face;
    if (read_decoupled(lump, i, face) >= 0 && has_place(face)) return true;
  }
  return false;
}

}  // namespace

Lightmaps::Lightmaps(const formats::Bsp& bsp, const std::optional<FileData>& lit) {
  if (!lit || !take_lit(bsp, *lit)) choose_samples(bsp);
  if (samples_.empty()) return;
  const ByteView decoupled = bspx_lump(bsp, "DECOUPLED_LM");
  bool has_decoupled = decoupled.size() == bsp.faces.size() * kDecoupledBytes;
  if (!decoupled.empty() && has_decoupled && !makes_sense(decoupled, bsp.faces.size())) {
    has_decoupled = false;
    errors_.emplace_back("its lump DECOUPLED_LM has no place for light on any face; it is not used");
  } else if (!decoupled.empty() && !has_decoupled)
    errors_.push_back(fmt::format("its lump DECOUPLED_LM has {} bytes where {} faces take {}; it is not used",
                                  decoupled.size(), bsp.faces.size(), bsp.faces.size() * kDecoupledBytes));
  std::size_t cut_faces = 0;
  for (std::size_t i = 0; i < bsp.faces.size(); ++i) {
    Face face = usual_face(bsp, bsp.faces[i]);
    std::int64_t offset = bsp.faces[i].light_offset;
    if (has_decoupled) offset = read_decoupled(decoupled, i, face);
    if (offset < 0 || !has_place(face)) {
      face.styles.fill(kNoStyle);
    } else {
      face.first = static_cast<std::uint64_t>(offset);
      const std::uint64_t luxels = static_cast<std::uint64_t>(face.width) * static_cast<std::uint64_t>(face.height);
      const std::uint64_t there = samples_.size() / static_cast<std::uint64_t>(channels_);
      bool cut = false;
      for (std::size_t k = 0; k < 4; ++k)
        if (face.styles[k] != kNoStyle && face.first + (k + 1) * luxels > there) {
          face.styles[k] = kNoStyle;
          cut = true;
        }
      if (cut) ++cut_faces;
    }
    faces_.push_back(face);
  }
  if (cut_faces > 0)
    errors_.push_back(fmt::format("the light of {} of its {} faces ends beyond its {} samples; it is left out",
                                  cut_faces, bsp.faces.size(), samples_.size() / static_cast<std::size_t>(channels_)));
}

bool Lightmaps::take_lit(const formats::Bsp& bsp, const FileData& lit) {
  constexpr std::size_t kLitHeader = 8;
  const ByteView bytes(lit.data(), lit.size());
  const bool named = bytes.size() >= kLitHeader && std::memcmp(bytes.data(), "QLIT", 4) == 0;
  if (bytes.empty()) {
    lit_error_ = "it is empty";
  } else if (!named || read<std::int32_t>(bytes, 4) != 1) {
    lit_error_ = "it is not a QLIT file of version 1";
  } else if (bytes.size() - kLitHeader != 3 * bsp.lighting.size() || bsp.lighting.empty()) {
    // As in QuakeSpasm: a file that is too long is of another map, or of the same before it was changed.
    lit_error_ = fmt::format("it has {} bytes of light where the map's {} samples take {}", bytes.size() - kLitHeader,
                             bsp.lighting.size(), 3 * bsp.lighting.size());
  } else {
    lit_ = lit;
    samples_ = bytes.subspan(kLitHeader);
    channels_ = 3;
    return true;
  }
  return false;
}

void Lightmaps::choose_samples(const formats::Bsp& bsp) {
  const ByteView rgb = bspx_lump(bsp, "RGBLIGHTING");
  if (!rgb.empty() && rgb.size() >= 3 * bsp.lighting.size()) {
    samples_ = rgb;
    channels_ = 3;
  } else {
    if (!rgb.empty())
      errors_.push_back(fmt::format("its lump RGBLIGHTING has {} bytes where {} samples take {}; it is not used",
                                    rgb.size(), bsp.lighting.size(), 3 * bsp.lighting.size()));
    samples_ = bsp.lighting;
  }
}

// QuakeSpasm's extents: from the corners' texture coordinates, rounded outwards to whole luxels.
Lightmaps::Face Lightmaps::usual_face(const formats::Bsp& bsp, const formats::BspFace& face) const {
  Face out;
  const formats::BspTexInfo& texinfo = bsp.texinfos[face.texinfo];
  vec2 low(1e30f), high(-1e30f);
  for (std::uint32_t k = 0; k < face.surfedge_count; ++k) {
    const glm::dvec3 p(bsp.face_vertex(face, k));
    for (int a = 0; a < 2; ++a) {
      const vec4& axis = texinfo.axes[static_cast<std::size_t>(a)];
      const auto s = static_cast<float>(glm::dot(glm::dvec3(vec3(axis)), p) + static_cast<double>(axis.w));
      low[a] = std::min(low[a], s);
      high[a] = std::max(high[a], s);
    }
  }
  if (face.surfedge_count < 3 || (texinfo.flags & formats::kTexSpecial) != 0) return out;
  std::array<int, 2> size{};
  for (int a = 0; a < 2; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const float first = std::floor(low[a] / kLuxelUnits), last = std::ceil(high[a] / kLuxelUnits);
    if (!(last - first < static_cast<float>(kMostLuxels))) return out;
    size[axis] = static_cast<int>(last - first) + 1;
    out.axes[axis] = texinfo.axes[axis] / kLuxelUnits;
    out.axes[axis].w -= first;
  }
  out.width = size[0];
  out.height = size[1];
  out.styles = face.styles;
  for (std::size_t k = 1; k < 4; ++k)
    if (out.styles[k - 1] == kNoStyle) out.styles[k] = kNoStyle;
  return out;
}

bool Lightmaps::has(std::uint32_t face, std::size_t k) const {
  return face < faces_.size() && faces_[face].styles[k] != kNoStyle;
}

double Lightmaps::black_share() const {
  std::uint64_t all = 0, black = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (!has(static_cast<std::uint32_t>(i), 0)) continue;
    const Face& face = faces_[i];
    for (int y = 0; y < face.height; ++y)
      for (int x = 0; x < face.width; ++x) {
        const auto bytes = luxel(face, 0, x, y);
        black += std::max({bytes[0], bytes[1], bytes[2]}) == 0 ? 1 : 0;
        ++all;
      }
  }
  return all > 0 ? static_cast<double>(black) / static_cast<double>(all) : 1.0;
}

std::array<std::uint8_t, 3> Lightmaps::luxel(const Face& face, std::size_t k, int x, int y) const {
  const auto width = static_cast<std::uint64_t>(face.width), height = static_cast<std::uint64_t>(face.height);
  const std::uint64_t sample =
      face.first + k * width * height + static_cast<std::uint64_t>(y) * width + static_cast<std::uint64_t>(x);
  const std::size_t at = static_cast<std::size_t>(sample) * static_cast<std::size_t>(channels_);
  if (channels_ == 1) return {samples_[at], samples_[at], samples_[at]};
  return {samples_[at], samples_[at + 1], samples_[at + 2]};
}

vec3 Lightmaps::value(std::uint32_t face, std::size_t k, const vec3& point) const {
  if (!has(face, k)) return vec3(0.0f);
  const Face& f = faces_[face];
  const auto place = [&](const vec4& axis, int size) {
    const float at = glm::dot(vec3(axis), point) + axis.w;
    return at > 0.0f ? std::min(at, static_cast<float>(size - 1)) : 0.0f;
  };
  const float s = place(f.axes[0], f.width), t = place(f.axes[1], f.height);
  const int s0 = std::min(static_cast<int>(s), f.width - 1), t0 = std::min(static_cast<int>(t), f.height - 1);
  const int s1 = std::min(s0 + 1, f.width - 1), t1 = std::min(t0 + 1, f.height - 1);
  const auto at = [&](int x, int y) {
    const std::array<std::uint8_t, 3> bytes = luxel(f, k, x, y);
    return vec3(bytes[0], bytes[1], bytes[2]);
  };
  const vec3 upper = glm::mix(at(s0, t0), at(s1, t0), s - static_cast<float>(s0));
  const vec3 lower = glm::mix(at(s0, t1), at(s1, t1), s - static_cast<float>(s0));
  return glm::mix(upper, lower, t - static_cast<float>(t0)) / kPainted;
}

vec3 light_of_display(const vec3& displayed, const vec3& reflectance) {
  vec3 light;
  for (int c = 0; c < 3; ++c) {
    const float linear = std::clamp(reflectance[c], kLeastReflectance, 1.0f), painted = encoded(linear);
    light[c] = linear_from_srgb(std::min(painted * displayed[c], 1.0f)) / linear;
  }
  return light;
}

float light_of_display(float displayed) { return std::pow(std::max(displayed, 0.0f), kDisplayGamma); }

}  // namespace fb::scene
