// From exposed radiance to the screen: the tone curve and sRGB. The laboratory shows references as frames are shown.
#ifndef FB_SHARED_TONE_H
#define FB_SHARED_TONE_H
#include "shared/common.h"
#ifdef __cplusplus
#include <glm/vector_relational.hpp>
#endif
FB_NAMESPACE_BEGIN
#ifdef __cplusplus
using glm::greaterThan;
using glm::pow;
#endif

FB_FN vec3 srgb_from_linear(vec3 c) {
  c = clamp(c, 0.0f, 1.0f);
  return mix(c * 12.92f, 1.055f * pow(c, vec3(1.0f / 2.4f)) - 0.055f, greaterThan(c, vec3(0.0031308f)));
}

// Narkowicz 2015, a rational fit to the ACES reference curve.
FB_FN vec3 filmic(vec3 c) { return (c * (2.51f * c + 0.03f)) / (c * (2.43f * c + 0.59f) + 0.14f); }

FB_NAMESPACE_END
#endif
