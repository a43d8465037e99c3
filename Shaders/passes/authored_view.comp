// What QuakeSpasm shows of a map (r_debug authored): textures times baked light, as bytes that a display decodes, what
// glows, fog.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/baked_light.glsl"
#include "lib/seen_texel.glsl"
#include "shared/displayed_fog.h"
#include "shared/tone.h"

vec3 authored_color(vec3 direction, Hit hit) {
  bool missed = hit.instance == kNoIndex;
  if (missed && frame.sky_beyond == 0u) return vec3(0.0);
  Surface s = load_surface(hit, direction, kFilterNearest, missed, true);
  vec3 glow = srgb_from_linear(clamp(s.emission, 0.0, 1.0));
  bool fog = FEATURE_MEDIUM && frame.camera_fog_square > 0.0;
  vec3 fog_color = srgb_from_linear(frame.fog_glow.rgb);
  float depth = haze_depth(camera_haze(), hit.t) / (kDisplayedMix * displayed_fog_rate(fog_color));
  float left = s.sky ? 1.0 - pow(frame.fog_glow.w, 1.0 / kDisplayedMix) : exp(-depth);
  vec3 shown = glow;
  if (!s.sky) {
    vec3 painted = srgb_from_linear(clamp(s.bsdf.albedo, 0.0, 1.0));
    // Texels that glow are whole; an image of what glows is added.
    bool whole = s.emission != vec3(0.0) && material_at(s.material).luma == kNoIndex;
    shown = whole ? max(glow, painted) : painted * baked_light(hit) + glow;
  }
  return fog ? mix(fog_color, min(shown, vec3(1.0)), left) : shown;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, rng = seen_rng(at);
  vec3 direction = normalize(camera_direction(point_of(pixel)));
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);
  ldr.at[at] = packUnorm4x8(vec4(clamp(authored_color(direction, hit), 0.0, 1.0), 1.0));
}
