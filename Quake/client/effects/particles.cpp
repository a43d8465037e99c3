#include "client/effects/particles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fb::cl {
namespace {

constexpr float kGravity = 800.0f;  // sv_gravity's default; particles feel a twentieth of it
constexpr std::size_t kRampLength = 8, kFireRampLength = 6;
constexpr std::array<std::uint8_t, kRampLength> kExplodeRamp = {0x6f, 0x6d, 0x6b, 0x69, 0x67, 0x65, 0x63, 0x61};
constexpr std::array<std::uint8_t, kRampLength> kExplode2Ramp = {0x6f, 0x6e, 0x6d, 0x6c, 0x6b, 0x6a, 0x68, 0x66};
constexpr std::array<std::uint8_t, kFireRampLength> kFireRamp = {0x6d, 0x6b, 6, 5, 4, 3};
constexpr int kBlastCount = 1024;  // svc_particle with this count is a rocket's explosion
constexpr int kFieldCount = 162;   // points of a bright field

// Advances along a ramp; at its end the particle dies, with its last colour, in the next run.
template <std::size_t N>
void burn(Particle& p, const std::array<std::uint8_t, N>& ramp, float steps) {
  p.ramp += steps;
  if (p.ramp >= static_cast<float>(N))
    p.die = -1.0;
  else
    p.color = ramp[static_cast<std::size_t>(p.ramp)];
}

}  // namespace

void ParticleSystem::clear() {
  particles_.clear();
  tracer_count_ = 0;
}

Particle* ParticleSystem::add(double die) {
  if (particles_.size() >= capacity_) return nullptr;
  Particle& p = particles_.emplace_back();
  p.serial = next_serial_++;
  p.die = die;
  return &p;
}

vec3 ParticleSystem::jitter(int low, int range) {
  vec3 v;
  for (int i = 0; i < 3; ++i)
    v[i] = static_cast<float>(low + static_cast<int>(rng_.below(static_cast<std::uint32_t>(range))));
  return v;
}

// A place within 16 units and a velocity up to 256 along each axis.
void ParticleSystem::burst(Particle& p, const vec3& origin) {
  p.origin = origin + jitter(-16, 32);
  p.velocity = jitter(-256, 512);
}

void ParticleSystem::run(double time, double seconds) {
  std::erase_if(particles_, [time](const Particle& p) { return p.die < time; });
  const auto dt = static_cast<float>(seconds);
  const float fall = dt * kGravity * 0.05f, swell = 4.0f * dt;
  for (Particle& p : particles_) {
    p.origin += p.velocity * dt;
    switch (p.type) {
      case ParticleType::kStatic:
        break;
      case ParticleType::kFire:
        burn(p, kFireRamp, dt * 5.0f);
        p.velocity.z += fall;  // rises
        break;
      case ParticleType::kExplode:
        burn(p, kExplodeRamp, dt * 10.0f);
        p.velocity += p.velocity * swell;
        p.velocity.z -= fall;
        break;
      case ParticleType::kExplode2:
        burn(p, kExplode2Ramp, dt * 15.0f);
        p.velocity -= p.velocity * dt;
        p.velocity.z -= fall;
        break;
      case ParticleType::kBlob:
        p.velocity += p.velocity * swell;
        p.velocity.z -= fall;
        break;
      case ParticleType::kBlob2:
        p.velocity.x -= p.velocity.x * swell;
        p.velocity.y -= p.velocity.y * swell;
        p.velocity.z -= fall;
        break;
      case ParticleType::kGravity:
      case ParticleType::kSlowGravity:
        p.velocity.z -= fall;
        break;
    }
  }
}

void ParticleSystem::effect(const vec3& origin, const vec3& direction, int color, int count, double time) {
  if (count == kBlastCount) {
    explosion(origin, time);
    return;
  }
  for (int i = 0; i < count; ++i) {
    Particle* p = add(time + 0.1 * rng_.below(5));
    if (!p) return;
    p->color = static_cast<std::uint8_t>((color & ~7) + static_cast<int>(rng_.below(8)));
    p->type = ParticleType::kSlowGravity;
    p->origin = origin + jitter(-8, 16);
    p->velocity = direction * 15.0f;
  }
}

void ParticleSystem::explosion(const vec3& origin, double time) {
  for (int i = 0; i < kBlastCount; ++i) {
    Particle* p = add(time + 5.0);
    if (!p) return;
    p->color = kExplodeRamp[0];
    p->ramp = static_cast<float>(rng_.below(4));
    p->type = i & 1 ? ParticleType::kExplode : ParticleType::kExplode2;
    burst(*p, origin);
  }
}

void ParticleSystem::color_explosion(const vec3& origin, int color_start, int color_length, double time) {
  const int length = std::max(color_length, 1);
  for (int i = 0; i < 512; ++i) {
    Particle* p = add(time + 0.3);
    if (!p) return;
    p->color = static_cast<std::uint8_t>(color_start + i % length);
    p->type = ParticleType::kBlob;
    burst(*p, origin);
  }
}

void ParticleSystem::blob_explosion(const vec3& origin, double time) {
  for (int i = 0; i < 1024; ++i) {
    Particle* p = add(time + 1.0 + (rng_.below(2) ? 0.4 : 0.0));
    if (!p) return;
    p->type = i & 1 ? ParticleType::kBlob : ParticleType::kBlob2;
    p->color = static_cast<std::uint8_t>((i & 1 ? 66 : 150) + static_cast<int>(rng_.below(6)));
    burst(*p, origin);
  }
}

void ParticleSystem::lava_splash(const vec3& origin, double time) {
  for (int i = -16; i < 16; ++i) {
    for (int j = -16; j < 16; ++j) {
      Particle* p = add(time + 2.0 + 0.02 * rng_.below(32));
      if (!p) return;
      p->color = static_cast<std::uint8_t>(224 + rng_.below(8));
      p->type = ParticleType::kSlowGravity;
      const vec3 direction(static_cast<float>(j * 8 + static_cast<int>(rng_.below(8))),
                           static_cast<float>(i * 8 + static_cast<int>(rng_.below(8))), 256.0f);
      p->origin = origin + vec3(direction.x, direction.y, static_cast<float>(rng_.below(64)));
      p->velocity = glm::normalize(direction) * static_cast<float>(50 + rng_.below(64));
    }
  }
}

void ParticleSystem::teleport_splash(const vec3& origin, double time) {
  for (int i = -16; i < 16; i += 4) {
    for (int j = -16; j < 16; j += 4) {
      for (int k = -24; k < 32; k += 4) {
        Particle* p = add(time + 0.2 + 0.02 * rng_.below(8));
        if (!p) return;
        p->color = static_cast<std::uint8_t>(7 + rng_.below(8));
        p->type = ParticleType::kSlowGravity;
        p->origin = origin + vec3(i, j, k) + jitter(0, 4);
        // x and y are swapped in the direction, as in Quake; the middle has none.
        const vec3 direction = vec3(j, i, k) * 8.0f;
        const float length = glm::length(direction);
        const auto speed = static_cast<float>(50 + rng_.below(64));
        p->velocity = length > 0.0f ? direction * (speed / length) : vec3(0.0f);
      }
    }
  }
}

void ParticleSystem::trail(const vec3& start, const vec3& end, Trail type, double time) {
  float left = glm::length(end - start);
  if (!(left > 0.0f)) return;
  const vec3 direction = (end - start) / left;
  vec3 at = start;
  while (left > 0.0f) {
    left -= 3.0f;
    Particle* p = add(time + 2.0);
    if (!p) return;
    p->origin = at;
    switch (type) {
      case Trail::kRocket:
      case Trail::kSmoke:
        p->ramp = static_cast<float>(rng_.below(4) + (type == Trail::kSmoke ? 2u : 0u));
        p->color = kFireRamp[static_cast<std::size_t>(p->ramp)];
        p->type = ParticleType::kFire;
        p->origin += jitter(-3, 6);
        break;
      case Trail::kSlightBlood:
        left -= 3.0f;
        [[fallthrough]];
      case Trail::kBlood:
        p->type = ParticleType::kGravity;
        p->color = static_cast<std::uint8_t>(67 + rng_.below(4));
        p->origin += jitter(-3, 6);
        break;
      case Trail::kTracer:
      case Trail::kTracer2: {
        p->die = time + 0.5;
        p->color = static_cast<std::uint8_t>((type == Trail::kTracer ? 52 : 230) + ((tracer_count_ & 4u) << 1u));
        ++tracer_count_;
        const float side = tracer_count_ & 1u ? 30.0f : -30.0f;
        p->velocity = {side * direction.y, -side * direction.x, 0.0f};
        break;
      }
      case Trail::kVoor:
        p->die = time + 0.3;
        p->color = static_cast<std::uint8_t>(152 + rng_.below(4));
        p->origin += jitter(-8, 16);
        break;
    }
    at += direction;
  }
}

void ParticleSystem::bright_field(const vec3& origin, double time) {
  constexpr float kDistance = 64.0f, kSwing = 16.0f;
  Rng speeds(1996);  // each point turns with a speed of its own, always the same one
  for (int i = 0; i < kFieldCount; ++i) {
    const auto yaw = static_cast<float>(time * speeds.uniform(0.0f, 2.55f));
    const auto pitch = static_cast<float>(time * speeds.uniform(0.0f, 2.55f));
    Particle* p = add(time + 0.01);
    if (!p) return;
    p->color = kExplodeRamp[0];
    p->type = ParticleType::kExplode;
    // Evenly on a sphere, by the golden angle, where Quake has the corners of its table of normals.
    const float z = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / kFieldCount;
    const float r = std::sqrt(1.0f - z * z), turn = 2.3999632f * static_cast<float>(i);
    const vec3 normal(r * std::cos(turn), r * std::sin(turn), z);
    const vec3 swing(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), -std::sin(pitch));
    p->origin = origin + normal * kDistance + swing * kSwing;
  }
}

}  // namespace fb::cl
