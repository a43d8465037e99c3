// Quake's particles: points with a colour of the palette, a velocity and one of eight behaviours. Numbers (lifetimes,
// spreads, ramps of colours) are Quake's; the random generator is ours, so that a demo gives the same particles always.
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "base/rng.h"

namespace fb::cl {

enum class ParticleType : std::uint8_t { kStatic, kGravity, kSlowGravity, kFire, kExplode, kExplode2, kBlob, kBlob2 };

struct Particle {
  vec3 origin{0.0f}, velocity{0.0f};  // units, units a second
  double die = 0.0;                   // client time
  float ramp = 0.0f;                  // steps along its ramp of colours
  std::uint32_t serial = 0;           // never the same twice
  std::uint8_t color = 0;             // palette index
  ParticleType type = ParticleType::kStatic;
  // Fire and explosions glow, and so do the palette's own glowing colours.
  bool glows() const {
    return color >= 224 || type == ParticleType::kFire || type == ParticleType::kExplode ||
           type == ParticleType::kExplode2;
  }
};

enum class Trail { kRocket, kSmoke, kBlood, kTracer, kSlightBlood, kTracer2, kVoor };

class ParticleSystem {
 public:
  explicit ParticleSystem(std::size_t capacity = 2048) : capacity_(capacity) {}

  void clear();
  void set_capacity(std::size_t capacity) { capacity_ = capacity; }
  std::size_t capacity() const { return capacity_; }
  const std::vector<Particle>& particles() const { return particles_; }

  // Moves everything on from `time` by `seconds` and forgets what died before `time`.
  void run(double time, double seconds);

  // Emitters. Those that come when the system is full are lost.
  void effect(const vec3& origin, const vec3& direction, int color, int count, double time);  // svc_particle
  void explosion(const vec3& origin, double time);
  void color_explosion(const vec3& origin, int color_start, int color_length, double time);  // TE_EXPLOSION2
  void blob_explosion(const vec3& origin, double time);                                      // TE_TAREXPLOSION
  void lava_splash(const vec3& origin, double time);
  void teleport_splash(const vec3& origin, double time);
  void trail(const vec3& start, const vec3& end, Trail type, double time);
  void bright_field(const vec3& origin, double time);  // EF_BRIGHTFIELD: a swarm around an entity, for one frame

 private:
  Particle* add(double die);
  vec3 jitter(int low, int range);  // whole numbers low .. low + range - 1
  void burst(Particle& p, const vec3& origin);

  std::size_t capacity_;
  std::vector<Particle> particles_;
  std::uint32_t next_serial_ = 1;
  std::uint32_t tracer_count_ = 0;
  Rng rng_{0x7061727469636c65ull};
};

}  // namespace fb::cl
