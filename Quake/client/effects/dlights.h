// Dynamic lights: muzzle flashes, rockets, explosions, glowing players. A slot a light; a light with a key (its entity)
// replaces the one before it.
#pragma once

#include <array>
#include <cstdint>

#include "base/maths.h"

namespace fb::cl {

struct DynamicLight {
  vec3 origin{0.0f}, color{1.0f};
  float radius = 0.0f;  // units that it reaches in Quake
  float decay = 0.0f;   // of radius, a second
  double die = -1.0;    // client time
  int key = 0;
  std::uint32_t serial = 0;  // another light in the same slot has another
  bool lit(double time) const { return die >= time && radius > 0.0f; }
};

class DynamicLights {
 public:
  static constexpr std::size_t kCount = 64;

  void clear();
  // The light of this key (0: none), or a free slot, or the first slot; emptied but for key and colour.
  DynamicLight& allocate(int key, double time);
  void decay(double time, double seconds);
  const std::array<DynamicLight, kCount>& lights() const { return lights_; }

 private:
  std::array<DynamicLight, kCount> lights_;
  std::uint32_t next_serial_ = 1;
};

// How a light of Quake's radius R becomes a sphere. In Quake a surface at distance d gets R - d of the 256 that make
// its texture twice as bright as painted, so R/256 of "as painted" halfway out, at d = R/2. A sphere of radius r and
// radiance L, facing a Lambertian surface of albedo a, gives it the radiance a L r^2 / d^2. Equal at d = R/2:
// L = (R/256) (R/2)^2 / r^2. With r = R/20 that is L = 0.39 R: brightness grows with the radius. In Quake what is near
// the light is no brighter than R/256; near a small sphere it is, so what is always near (the player's own weapon in
// its own flash) wants a wide one: r = R/5, L = 0.024 R.
struct LightSphere {
  float radius;    // units
  float radiance;  // linear
};
constexpr LightSphere light_sphere(float quake_radius, bool wide = false) {
  const float r = quake_radius / (wide ? 5.0f : 20.0f);
  const float half = quake_radius * 0.5f;
  return {r, quake_radius / 256.0f * half * half / (r * r)};
}

}  // namespace fb::cl
