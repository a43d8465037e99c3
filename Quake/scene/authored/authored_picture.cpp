#include "scene/authored/authored_picture.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "scene/authored/map_rays.h"
#include "scene/library/asset_builder.h"
#include "scene/library/surface_names.h"
#include "shared/tone.h"

namespace fb::scene {
namespace {

constexpr int kSamples = 4;  // of a pixel, each way
constexpr float kFar = 65536.0f;
constexpr float kFogUnits = 64.0f;
constexpr int kMostHoles = 32;        // of textures that let see through, one behind the other
constexpr float kPastHole = 0.0625f;  // units

struct Texel {
  vec3 color;  // as displayed
  bool glows, hole = false;
};

Texel texel_at(const Assets& assets, std::uint32_t image_index, vec2 uv) {
  if (image_index >= assets.images.size()) return {vec3(0.5f), false};
  const Image& image = assets.images[image_index];
  const auto place = [](float u, int size) {
    return std::clamp(static_cast<int>((u - std::floor(u)) * static_cast<float>(size)), 0, size - 1);
  };
  const std::size_t at = static_cast<std::size_t>(place(uv.y, image.height)) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(place(uv.x, image.width));
  constexpr std::uint8_t kFirstGlowing = 224;
  if (image.encoding == ImageEncoding::kPalette) {
    const auto& rgb = assets.palette.rgb[image.texels[at]];
    return {vec3(rgb[0], rgb[1], rgb[2]) / 255.0f, image.texels[at] >= kFirstGlowing, image.texels[at] == 255};
  }
  if (image.encoding != ImageEncoding::kSrgba) return {vec3(0.5f), false};
  return {vec3(image.texels[4 * at], image.texels[4 * at + 1], image.texels[4 * at + 2]) / 255.0f, false,
          image.texels[4 * at + 3] < 128};
}

class Painter {
 public:
  Painter(const LitMap& map, const Assets& assets, const Sky& sky, const Lightmaps& lightmaps, const AuthoredFog& fog,
          const std::vector<float>& styles)
      : map_(map), assets_(assets), lightmaps_(lightmaps), fog_(fog), styles_(styles), rays_(map.bsp, map.submodels) {
    sky_ = mean_of_sky(assets, sky) / glm::max(sky.color, vec3(1e-3f));
  }

  vec3 color(const vec3& from, const vec3& direction) const { return color_beyond(from, from, direction, kMostHoles); }

 private:
  // Of the line from `start` on; `from` is the eye.
  vec3 color_beyond(const vec3& from, const vec3& start, const vec3& direction, int holes) const {
    const auto hit = rays_.first_face(start, start + direction * kFar, true);
    if (!hit) return vec3(0.0f);
    if (rays_.is_sky(hit->face)) return fog_.density > 0.0f ? sky_in_fog() : sky_;
    const formats::BspFace& face = map_.bsp.faces[hit->face];
    const formats::BspTexInfo& texinfo = map_.bsp.texinfos[face.texinfo];
    const LitSurface* surface = map_.surface_of(face);
    const Material* material = surface != nullptr ? &assets_.materials[surface->material] : nullptr;
    vec3 shown(0.5f);
    bool glows = false;
    if (material != nullptr && !material->frames.empty()) {
      const formats::BspTexture& texture = map_.bsp.textures[texinfo.texture];
      const vec2 uv(
          (glm::dot(vec3(texinfo.axes[0]), hit->point) + texinfo.axes[0].w) / static_cast<float>(texture.width),
          (glm::dot(vec3(texinfo.axes[1]), hit->point) + texinfo.axes[1].w) / static_cast<float>(texture.height));
      const Texel texel = texel_at(assets_, material->frames.front().base, uv);
      if (texel.hole && (material->flags & kMaterialAlphaTest) != 0 && holes > 0)
        return color_beyond(from, hit->point + hit->offset + direction * kPastHole, direction, holes - 1);
      shown = texel.color;
      glows = liquid_kind(texture.name) != LiquidKind::kNone ||
              (texel.glows && (material->flags & kMaterialNoFullbright) == 0);
      if (!glows) shown = shown * light_at(*hit);
      if (!glows && material->frames.front().luma != kNone)
        shown += texel_at(assets_, material->frames.front().luma, uv).color;
    }
    shown = glm::clamp(shown, vec3(0.0f), vec3(1.0f));
    const float way = fog_.density / kFogUnits * glm::length(hit->point + hit->offset - from);
    shown = glm::mix(fog_.color, shown, std::exp(-way * way));
    return {linear_from_srgb(shown.x), linear_from_srgb(shown.y), linear_from_srgb(shown.z)};
  }

  vec3 sky_in_fog() const {
    const vec3 shown = glm::mix(shared::srgb_from_linear(sky_), fog_.color, fog_.covers);
    return {linear_from_srgb(shown.x), linear_from_srgb(shown.y), linear_from_srgb(shown.z)};
  }

  vec3 light_at(const MapRays::Hit& hit) const {
    if (lightmaps_.empty()) return vec3(1.0f);
    vec3 light(0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!lightmaps_.has(hit.face, k)) continue;
      const std::size_t style = lightmaps_.style(hit.face, k);
      light += lightmaps_.value(hit.face, k, hit.point) * (style < styles_.size() ? styles_[style] : 1.0f);
    }
    return light;
  }

  const LitMap& map_;
  const Assets& assets_;
  const Lightmaps& lightmaps_;
  const AuthoredFog& fog_;
  const std::vector<float>& styles_;
  MapRays rays_;
  vec3 sky_{0.0f};
};

}  // namespace

std::vector<vec3> authored_picture(const LitMap& map, const Assets& assets, const Sky& sky, const Lightmaps& lightmaps,
                                   const Camera& camera, std::uint32_t width, std::uint32_t height,
                                   const AuthoredFog& fog, const std::vector<float>& styles) {
  const Painter painter(map, assets, sky, lightmaps, fog, styles);
  const AxisVectors axes = angle_vectors(camera.angles);
  const float across = std::tan(radians(camera.fov_x) * 0.5f);
  const float down = camera.fov_y > 0.0f ? std::tan(radians(camera.fov_y) * 0.5f)
                                         : across * static_cast<float>(height) / static_cast<float>(width);
  std::vector<vec3> picture(std::size_t{width} * height, vec3(0.0f));
  parallel_for(height, 4, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      vec3 sum(0.0f);
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const float u = (static_cast<float>(x) + (static_cast<float>(k % kSamples) + 0.5f) / kSamples) /
                            static_cast<float>(width) * 2.0f -
                        1.0f;
        const float v = (static_cast<float>(y) + (static_cast<float>(k / kSamples) + 0.5f) / kSamples) /
                            static_cast<float>(height) * 2.0f -
                        1.0f;
        sum += painter.color(camera.position,
                             glm::normalize(axes.forward + axes.right * (u * across) - axes.up * (v * down)));
      }
      picture[y * width + x] = sum / static_cast<float>(kSamples * kSamples);
    }
  });
  return picture;
}

}  // namespace fb::scene
