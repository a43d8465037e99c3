// How the paths of a pixel end: their mean, with what the surface emits and what fog leaves of the light, in the arrays
// that the frame's passes read. What is not finite counts as zero, and is counted.
#ifndef FB_LIB_STORE_LIGHT
#define FB_LIB_STORE_LIGHT
#include "lib/pixel_start.glsl"

// Of the samples of a pixel so far.
struct PixelLight {
  vec3 sum;
  vec4 second;  // of those of a second surface, seen by way of water; w: their number
  float lost;   // samples that were not finite
};
PixelLight no_light() { return PixelLight(vec3(0.0), vec4(0.0), 0.0); }

// Zero in the place of what is not finite; true: it was.
bool take_finite(inout vec3 estimate) {
  if (!any(isnan(estimate)) && !any(isinf(estimate))) return false;
  atomicAdd(counters.at[kCounterNan], 1u);
  estimate = vec3(0.0);
  return true;
}

// What a path brought.
void add_sample(inout PixelLight light, Path path, vec3 estimate) {
  if (shows_two()) estimate *= path.factor;
  if (take_finite(estimate)) light.lost += 1.0;
  light.sum += estimate;
  if (shows_two()) light.second += path.second ? vec4(estimate, 1.0) : vec4(0.0);
}

// Of a pixel that reflects nothing.
void store_emission(PathPixel p, GBufferTexel g) {
  radiance.at[p.at] = vec4(g.emission_specular.rgb, 0.0);
  if (shows_two()) radiance.at[second_radiance_at(p.at)] = vec4(0.0);
}

// The mean of so many samples.
void store_light(PathPixel p, GBufferTexel g, PixelLight light, float samples) {
  float left = FEATURE_MEDIUM ? haze_left(camera_haze(), g.position_t.w) : 1.0;
  if (FEATURE_MEDIUM) light.sum *= left;
  if (shows_two()) radiance.at[second_radiance_at(p.at)] = vec4(light.second.rgb * left, light.second.w) / samples;
  radiance.at[p.at] = vec4(g.emission_specular.rgb + light.sum / samples, light.lost);
}

// More light that a pixel's surface reflects, where paths have been stored.
void add_light(PathPixel p, GBufferTexel g, vec3 light) {
  take_finite(light);
  if (FEATURE_MEDIUM) light *= haze_left(camera_haze(), g.position_t.w);
  radiance.at[p.at].rgb += light;
}
#endif
