// Packing of directions and numbers into words, the same on host and device.
#ifndef FB_SHARED_PACKING_H
#define FB_SHARED_PACKING_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// Octahedral map of a unit vector to [-1, 1]^2 (Cigolle 2014).
FB_FN vec2 octahedral_from_direction(vec3 d) {
  float s = 1.0f / (abs(d.x) + abs(d.y) + abs(d.z));
  vec2 p = vec2(d.x * s, d.y * s);
  if (d.z >= 0.0f) return p;
  return vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f), (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
}

FB_FN vec3 direction_from_octahedral(vec2 p) {
  vec3 d = vec3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
  if (d.z < 0.0f) {
    float x = (1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f);
    float y = (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f);
    d.x = x;
    d.y = y;
  }
  return normalize(d);
}

// Two signed 16-bit normalised numbers, first in the low half. Rounds to nearest; error at most 1/65534.
FB_FN uint pack_snorm2x16(vec2 v) {
  float x = clamp(v.x, -1.0f, 1.0f) * 32767.0f, y = clamp(v.y, -1.0f, 1.0f) * 32767.0f;
  int ix = int(x + (x >= 0.0f ? 0.5f : -0.5f)), iy = int(y + (y >= 0.0f ? 0.5f : -0.5f));
  return (uint(ix) & 0xffffu) | (uint(iy) << 16u);
}

FB_FN vec2 unpack_snorm2x16(uint u) {
  int ix = int(u << 16u) >> 16, iy = int(u) >> 16;
  return vec2(max(float(ix) / 32767.0f, -1.0f), max(float(iy) / 32767.0f, -1.0f));
}

// Whole numbers of a pose's vertex: eleven bits, eleven, ten, x lowest.
const uint kMostPoseX = 2047u, kMostPoseY = 2047u, kMostPoseZ = 1023u;
FB_FN uint pack_pose_position(uint x, uint y, uint z) { return x | (y << 11u) | (z << 22u); }
FB_FN vec3 unpack_pose_position(uint word) {
  return vec3(float(word & kMostPoseX), float((word >> 11u) & kMostPoseY), float(word >> 22u));
}

FB_FN uint pack_direction(vec3 d) { return pack_snorm2x16(octahedral_from_direction(d)); }
FB_FN vec3 unpack_direction(uint u) { return direction_from_octahedral(unpack_snorm2x16(u)); }

FB_NAMESPACE_END
#endif
