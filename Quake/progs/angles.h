// Angles as the game's rules have them: degrees, from 0 up to 360, and where Quake is coarse, as coarse.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/maths.h"
#include "progs/value.h"

namespace fb::progs {

// To [0, 360), in steps of 360/65536 (Quake's anglemod).
inline float angle_mod(float degrees) {
  const int steps = to_int(static_cast<double>(degrees) * (65536.0 / 360.0)) & 65535;
  return static_cast<float>((360.0 / 65536.0) * steps);
}

// Whole degrees, cut: what monsters turn by.
inline float whole_degrees(double y, double x) {
  const int angle = to_int(std::atan2(y, x) * 180.0 / 3.14159265358979323846);
  return static_cast<float>(angle < 0 ? angle + 360 : angle);
}

inline float vector_to_yaw(const vec3& v) { return v.x == 0.0f && v.y == 0.0f ? 0.0f : whole_degrees(v.y, v.x); }

// Pitch is positive upwards here, unlike that of an entity's angles: QuakeC negates it.
inline vec3 vector_to_angles(const vec3& v) {
  if (v.x == 0.0f && v.y == 0.0f) return {v.z > 0.0f ? 90.0f : 270.0f, 0.0f, 0.0f};
  const auto forward = static_cast<float>(std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y)));
  return {whole_degrees(v.z, forward), vector_to_yaw(v), 0.0f};
}

// `angles` turned around one axis by at most `speed` towards `ideal`, the short way (Quake's PF_changeyaw). What is
// there already stays as it is, to the bit.
inline vec3 turned_towards(vec3 angles, int axis, float ideal, float speed) {
  const float current = angle_mod(angles[axis]);
  if (current == ideal) return angles;
  float move = ideal - current;
  if (ideal > current) {
    if (move >= 180.0f) move -= 360.0f;
  } else if (move <= -180.0f) {
    move += 360.0f;
  }
  // Not clamped: with a negative speed Quake turns away.
  move = move > 0.0f ? std::min(move, speed) : std::max(move, -speed);
  angles[axis] = angle_mod(current + move);
  return angles;
}

}  // namespace fb::progs
