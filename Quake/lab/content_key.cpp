#include "lab/content_key.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "base/hash.h"
#include "render/passes/frame_keys.h"

namespace fb::lab {
namespace {

template <typename T>
std::uint64_t hash_vector(const std::vector<T>& items, std::uint64_t seed) {
  return hash_span(std::span<const T>(items), hash_bytes(nullptr, 0, seed ^ items.size()));
}
template <typename T>
std::uint64_t hash_value(const T& value, std::uint64_t seed) {
  static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
  return hash_bytes(&value, sizeof value, seed);
}

std::uint64_t material_key(const scene::Material& m, std::uint64_t key) {
  key = hash_vector(m.frames, hash_vector(m.alternate_frames, hash_vector(m.end_times, key)));
  const bool filled = (m.flags & scene::kMaterialDielectric) != 0;  // else what is behind it is not seen
  const vec3 absorption = filled ? m.absorption : vec3(0.0f);
  const float numbers[] = {m.frames_per_second, m.base_color.x, m.base_color.y,
                           m.base_color.z,      m.emission.x,   m.emission.y,
                           m.emission.z,        m.roughness,    m.specular,
                           m.metalness,         m.alpha,        absorption.x,
                           absorption.y,        absorption.z,   filled ? m.scattering : 0.0f};
  key = hash_span(std::span<const float>(numbers), key);
  if (filled && m.index != scene::Material().index)
    key = hash_value(m.index, key);  // water's: keys of stored pictures stay
  return hash_value(m.flags, hash_value(static_cast<std::uint32_t>(m.emission_kind), key));
}

// Without their faces, which are not seen: keys of stored pictures stay.
std::uint64_t triangles_key(const std::vector<scene::MeshTriangle>& triangles, std::uint64_t key) {
  constexpr std::size_t kSeen = offsetof(scene::MeshTriangle, face);
  std::vector<std::byte> bytes(triangles.size() * kSeen);
  for (std::size_t i = 0; i < triangles.size(); ++i) std::memcpy(bytes.data() + i * kSeen, &triangles[i], kSeen);
  return hash_bytes(bytes.data(), bytes.size(), hash_bytes(nullptr, 0, key ^ triangles.size()));
}

std::uint64_t assets_key(const scene::Assets& assets, bool authored) {
  std::uint64_t key = hash_bytes(&assets.palette, sizeof assets.palette);
  for (const scene::Image& image : assets.images)
    if (authored || image.encoding != scene::ImageEncoding::kWords)
      key = hash_vector(image.texels,
                        hash_value(image.width, hash_value(static_cast<std::uint32_t>(image.encoding), key)));
  for (const scene::Material& material : assets.materials) key = material_key(material, key);
  for (const scene::Mesh& mesh : assets.meshes) {
    key = triangles_key(mesh.triangles, key);
    key = hash_vector(mesh.positions, hash_vector(mesh.normals, hash_vector(mesh.poses, key)));
    const float pose[] = {mesh.pose_scale.x,  mesh.pose_scale.y,  mesh.pose_scale.z,
                          mesh.pose_origin.x, mesh.pose_origin.y, mesh.pose_origin.z};
    key = hash_span(std::span<const float>(pose), key);
  }
  return key;
}

}  // namespace

std::uint64_t content_key(const scene::FrameSnapshot& s) {
  static_assert(sizeof(scene::Instance) == 4 * 43, "hashed as bytes: no padding");
  std::uint64_t key = s.assets ? assets_key(*s.assets, s.authored) : 0;
  key = hash_vector(s.instances, key);
  key = render::sky_key(s.sky, hash_bytes(&s.camera, sizeof s.camera, key));
  key = hash_value(s.camera_liquid, hash_bytes(&s.medium, offsetof(scene::Medium, square), key));
  if (s.medium.square > 0.0f) {
    const float own[] = {s.medium.square, s.medium.glow.x, s.medium.glow.y, s.medium.glow.z, s.medium.glow_before_sky};
    key = hash_span(std::span<const float>(own), key);
  }
  if (s.liquid_opacity != scene::LiquidOpacity()) {  // else it changes nothing: keys of stored pictures stay
    key = hash_bytes(&s.liquid_opacity, sizeof s.liquid_opacity, key);
    if (s.assets)
      for (const scene::Material& m : s.assets->materials) {
        key = hash_value(static_cast<std::uint32_t>(m.opacity_from), key);
        if (scene::lets_light_in(m, s.liquid_opacity))
          key = hash_value(m.scattering, hash_bytes(&m.absorption, sizeof m.absorption, key));
      }
  }
  if (s.assets)  // at 1 they change nothing: keys of stored pictures stay
    for (const scene::Material& m : s.assets->materials) {
      const auto style = static_cast<std::size_t>(m.cast_style);  // a damaged map's may be any number
      if (style >= s.light_styles.size() || s.light_styles[style] == 1.0f || !(s.authored || m.switched)) continue;
      key = hash_value(m.cast_style, hash_value(m.switched ? 1 : 0, hash_value(s.light_styles[style], key)));
    }
  if (s.authored && s.assets)
    for (const scene::Material& m : s.assets->materials)
      key = hash_value(m.cast_fall, hash_bytes(&m.cast, sizeof m.cast, key));
  return hash_value(s.time, hash_bytes(&s.ambient, sizeof s.ambient, key));
}

}  // namespace fb::lab
