#include "render/passes/frame_keys.h"

#include <span>

#include "base/hash.h"

namespace fb::render {

std::uint64_t sky_key(const scene::Sky& sky, std::uint64_t key) {
  static_assert(sizeof(scene::Sun) == 4 * 7, "hashed as bytes: no padding");
  const std::uint32_t images[] = {static_cast<std::uint32_t>(sky.mode), sky.solid, sky.alpha, sky.beyond_everything};
  key = hash_span(std::span<const std::uint32_t>(images), hash_bytes(&sky.color, sizeof sky.color, key));
  key = hash_span(std::span<const std::uint32_t>(sky.box), key);
  if (sky.even != vec3(0.0f)) key = hash_bytes(&sky.even, sizeof sky.even, key);
  return hash_span(std::span<const scene::Sun>(sky.suns), hash_bytes(nullptr, 0, key ^ sky.suns.size()));
}

std::uint64_t scene_key(const scene::FrameSnapshot& s) {
  static_assert(sizeof(scene::Instance) == 4 * 43, "hashed as bytes: no padding");
  std::uint64_t key = hash_span(std::span<const scene::Instance>(s.instances), s.assets->generation);
  const float camera[] = {s.camera.position.x, s.camera.position.y, s.camera.position.z, s.camera.angles.x,
                          s.camera.angles.y,   s.camera.angles.z,   s.camera.fov_x,      s.camera.fov_y,
                          s.ambient.x,         s.ambient.y,         s.ambient.z,         s.in_liquid ? 1.0f : 0.0f};
  key = hash_bytes(&s.time, sizeof(s.time), key);
  key = hash_bytes(&s.medium, sizeof(s.medium), key);
  key = hash_bytes(&s.liquid_opacity, sizeof(s.liquid_opacity), key);
  key = hash_bytes(&s.camera_liquid, sizeof(s.camera_liquid), key);
  if (s.authored) key = hash_bytes(&s.authored, sizeof(s.authored), key);
  key = hash_span(std::span<const float>(s.light_styles), key);
  key = sky_key(s.sky, key);
  return hash_span(std::span<const float>(camera), key);
}

std::uint64_t settings_key(const RenderSettings& settings, std::uint64_t seed) {
  std::uint64_t key = hash_bytes(settings.estimator.data(), settings.estimator.size(), seed);
#define FB_HASH(type, field, cvar, value, low, high, help) \
  key = hash_bytes(&settings.field, sizeof settings.field, hash_bytes(cvar, sizeof cvar, key));
  FB_RENDER_SETTINGS(FB_HASH)
#undef FB_HASH
  return key;
}

std::uint64_t view_key(std::uint64_t scene, const RenderSettings& settings) { return settings_key(settings, scene); }

}  // namespace fb::render
