// Products and lengths in floats, term by term in Quake's order: glm promises neither.
#pragma once

#include <cmath>

#include "base/maths.h"

namespace fb::sv {

inline float dot(const vec3& a, const vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline vec3 cross(const vec3& a, const vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const vec3& v) { return std::sqrt(dot(v, v)); }
// Makes it a unit vector, by its inverse length, and returns the length; zero stays.
inline float normalize(vec3& v) {
  const float size = length(v);
  if (size != 0.0f) v *= 1.0f / size;
  return size;
}

}  // namespace fb::sv
