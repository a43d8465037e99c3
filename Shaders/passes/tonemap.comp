// Radiance to displayable colour: exposure, a filmic curve, sRGB, half a step of dither against banding. Or a debug view
// of a buffer instead.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "lib/exposure.glsl"
#include "shared/packing.h"
#include "shared/rng.h"

vec3 srgb_from_linear(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// Narkowicz 2015, a rational fit to the ACES reference curve.
vec3 filmic(vec3 c) { return (c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14); }

vec3 id_color(uint id) {
  uint h = hash_u32(id + 1u);
  return vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;
}

vec3 debug_color(uint at) {
  GBufferTexel g = gbuffer[at];
  switch (frame.debug_view) {
    case 1u: return unpack_direction(g.normal) * 0.5 + 0.5;
    case 2u: return unpack_direction(g.shading_normal) * 0.5 + 0.5;
    case 3u: return srgb_from_linear(g.albedo_roughness.rgb);
    case 4u: return srgb_from_linear(filmic(g.emission_specular.rgb * exposure_state.exposure));
    case 5u: return vec3(exp2(-g.motion.z / 512.0));
    case 6u: return vec3(g.motion.xy / 16.0 + 0.5, 0.5);
    case 7u: return id_color(g.id);
    case 8u: return id_color(g.material_metalness & 0xffffffu);
    case 9u: return vec3(g.albedo_roughness.w, g.emission_specular.w, float(g.material_metalness >> 24u) / 255.0);
    case 10u: return srgb_from_linear(filmic(radiance[at].rgb * exposure_state.exposure));
    default: {  // standard error of the mean, relative to the mean
      float n = mean_radiance[at].w;
      float variance = n > 1.0 ? luminance(m2_radiance[at].rgb) / ((n - 1.0) * n) : 0.0;
      return vec3(sqrt(variance) / max(luminance(mean_radiance[at].rgb), 1e-6));
    }
  }
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  if (frame.debug_view >= kFirstGuideView) return;
  vec3 color;
  if (frame.debug_view != 0u) {
    color = debug_color(at);
  } else {
    vec3 linear = mean_radiance[at].rgb * exposure_state.exposure;
    color = srgb_from_linear(frame.tone_map != 0u ? filmic(linear) : linear);
    float dither = float(hash_u32(at) >> 8u) * (1.0 / 16777216.0) - 0.5;
    color += dither / 255.0;
  }
  ldr[at] = packUnorm4x8(vec4(color, 1.0));
}
