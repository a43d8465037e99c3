// What a frame without a past begins with where the map has baked light: that, as r_baked_past frames of history. It joins what the
// pass before has made of this frame's samples.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/baked_light.glsl"
#include "lib/seen_texel.glsl"
#include "shared/baked_past.h"

FB_FRAME_ARRAY(kBindHistory, 16, , HistoryArray, uvec4, history)
FB_FRAME_ARRAY(kBindHistory, 4, , HistoryWordArray, uint, history_words)

uint section_texel(uint section, uint at) { return section * frame.width * frame.height + at; }

// The moments stay those of samples, by which later frames tell whether the light has changed.
void join(uint at, vec3 past) {
  uint filtered = section_texel(kSectionFilter, at), kept = section_texel(kSectionHistory + frame.history_parity, at);
  uvec4 texel = history.at[filtered];
  if (texel.z == 0u) return;  // nothing to filter
  float own = float(texel.w & 0xffu), share = share_beside_past(own, frame.baked_past);
  vec3 irradiance = mix(past, unpack_rgb9e5(texel.x), share);
  float y = dot(past, vec3(0.2126, 0.7152, 0.0722));
  vec2 moments = unpackHalf2x16(history_words.at[kept * 4u + 2u]);
  float apart = moments.x - y, variance = variance_with_past(apart * apart, y, own + frame.baked_past, frame.baked_past);
  float deviation = min(sqrt(variance * share), kMaxDeviation);
  uint others = texel.w & ~0xffu, frames = uint(min(own + frame.baked_past, float(kMaxHistory)) + 0.5);
  history.at[filtered] = uvec4(pack_rgb9e5(irradiance, 0.5), packHalf2x16(vec2(deviation, 0.0)), texel.z, others | frames);
  history_words.at[section_texel(kSectionFilter + 1u, at) * 4u + 3u] = others | frames;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, rng = seen_rng(at);
  vec3 direction = normalize(camera_direction(point_of(pixel)));
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);
  if (hit.instance == kNoIndex || !has_baked_light(hit)) return;
  Surface s = load_seen_surface(hit, direction, false);
  join(at, baked_irradiance(baked_light(hit), authored_gain(s.position, s.normal), frame.ambient.rgb));
}
