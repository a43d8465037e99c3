// The tone curve and sRGB.
#ifndef FB_LIB_TONE
#define FB_LIB_TONE

vec3 srgb_from_linear(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// Narkowicz 2015, a rational fit to the ACES reference curve.
vec3 filmic(vec3 c) { return (c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14); }
#endif
