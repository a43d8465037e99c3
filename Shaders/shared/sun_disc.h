// A sun's disc, by the direction towards its middle and 1 - the cosine of its radius (of a radius of 0.05 degrees the
// cosine itself has six steps of a float left).
#ifndef FB_SHARED_SUN_DISC_H
#define FB_SHARED_SUN_DISC_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST float kSunDiscPi = 3.14159265358979f;

// Both directions unit. The square of their difference is twice 1 - the cosine between them, and keeps its digits.
FB_FN bool within_sun(vec3 direction, vec3 middle, float disc) {
  vec3 off = direction - middle;
  return dot(off, off) <= 2.0f * disc;
}
FB_FN float sun_solid_angle(float disc) { return 2.0f * kSunDiscPi * disc; }

FB_NAMESPACE_END
#endif
