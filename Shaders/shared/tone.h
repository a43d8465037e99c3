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

// Narkowicz 2016, a rational fit to the ACES reference curve.
FB_FN float filmic_curve(float x) { return min(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f); }

// How soon what is brighter than white turns white: half way at 1 / kWhitening.
const float kWhitening = 0.02f;

// Half of it is the curve of each channel by itself, as film has it: it turns bright fire yellow, but makes browns
// orange and every lamp white. In the other half the curve is the brightest channel's, and the others keep their ratio
// to it. Below zero is black: means of estimates that may be negative end here.
FB_FN vec3 filmic(vec3 c) {
  c = max(c, vec3(0.0f));
  float peak = max(max(c.x, c.y), c.z), shown = filmic_curve(peak), scale = peak > 0.0f ? shown / peak : 0.0f;
  float white = kWhitening * peak / (1.0f + kWhitening * peak);
  vec3 kept = mix(c * scale, vec3(shown), white);
  return 0.5f * (kept + vec3(filmic_curve(c.x), filmic_curve(c.y), filmic_curve(c.z)));
}

FB_NAMESPACE_END
#endif
