// The equal-area map of the square to the sphere (octahedral: Clarberg 2008): alike on host and device.
#ifndef FB_SHARED_EQUAL_AREA_H
#define FB_SHARED_EQUAL_AREA_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST float kSpherePi = 3.14159265358979323846f;

// The square [-1, 1]^2 and the unit sphere, 1 of the square to pi of the sphere.
// Within |x| + |y| <= 1 is the upper half, z >= 0, beyond it the lower. The square's corners are all -z.
FB_FN vec3 direction_from_equal_area(vec2 p) {
  float x = abs(p.x), y = abs(p.y), up = 1.0f - (x + y), r = 1.0f - abs(up);
  float phi = r > 0.0f ? (1.0f + (y - x) / r) * (0.25f * kSpherePi) : 0.0f;
  float sine = r * sqrt(2.0f - r * r), cosine = 1.0f - r * r;
  return vec3((p.x < 0.0f ? -1.0f : 1.0f) * sine * cos(phi), (p.y < 0.0f ? -1.0f : 1.0f) * sine * sin(phi),
              up < 0.0f ? -cosine : cosine);
}

// atan(x) 2 / pi for x in [0, 1], within 1.2e-7 of it: a minimax polynomial, alike on host and device.
FB_FN float quadrant_arctangent(float x) {
  float t = x * x;
  return x * (0.636619687f +
              t * (-0.212198049f +
                   t * (0.127131209f +
                        t * (-0.0892507881f +
                             t * (0.0631163418f + t * (-0.0378702059f + t * (0.0154395541f - t * 0.00298783090f)))))));
}

// The inverse; within 5e-7 of it for unit vectors. 1 - |z| is taken of x and y, so that poles keep their digits.
FB_FN vec2 equal_area_from_direction(vec3 d) {
  float x = abs(d.x), y = abs(d.y);
  float r = min(sqrt((x * x + y * y) / (1.0f + abs(d.z))), 1.0f);
  float slope = quadrant_arctangent(min(x, y) / max(max(x, y), 1e-30f));
  float v = r * (y > x ? 1.0f - slope : slope), u = r - v;
  if (d.z < 0.0f) {
    float beyond = 1.0f - v;
    v = 1.0f - u;
    u = beyond;
  }
  return vec2(d.x < 0.0f ? -u : u, d.y < 0.0f ? -v : v);
}

FB_NAMESPACE_END
#endif
