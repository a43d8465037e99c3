// What the map's baked light says of each pixel of a frame without a past, for denoise_baked_join.comp. It stands where
// the wavelet's first level writes later.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/baked_light.glsl"
#include "lib/seen_texel.glsl"
#include "shared/baked_past.h"

FB_FRAME_ARRAY(kBindHistory, 4, , HistoryWordArray, uint, history_words)

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, rng = seen_rng(at);
  vec3 direction = normalize(camera_direction(point_of(pixel)));
  Hit hit = trace(frame.camera_position.xyz, direction, 0.0, kRayEnd, kMaskCamera, rng);
  uint word = kNoBakedPast;
  if (hit.instance != kNoIndex && has_baked_light(hit)) {
    Surface s = load_seen_surface(hit, direction, false);
    word = pack_rgb9e5(baked_irradiance(baked_light(hit), authored_gain(s.position, s.normal), frame.ambient.rgb), 0.5);
  }
  history_words.at[((kSectionHistory + frame.history_parity) * frame.width * frame.height + at) * 4u] = word;
}
