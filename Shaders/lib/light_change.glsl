// Tiles of shared/light_change.h in the history buffer: behind the anti-aliased pictures.
#ifndef FB_LIB_LIGHT_CHANGE
#define FB_LIB_LIGHT_CHANGE
#include "lib/denoise.glsl"
#include "shared/light_change.h"

uvec2 change_tiles() { return (uvec2(frame.width, frame.height) + kChangeTile - 1u) / kChangeTile; }
uint change_word(uvec2 tile) {
  return first_layer(frame.width * frame.height, frame.smooth_width * frame.smooth_height) * 4u +
         (tile.y * change_tiles().x + tile.x) * kChangeWords;
}
ChangeSums change_sums(uvec2 tile) {
  uint at = change_word(tile) / 4u;
  vec4 a = uintBitsToFloat(history_quad(at)), b = uintBitsToFloat(history_quad(at + 1u));
  return ChangeSums(a.x, a.y, a.z, a.w, b.x, b.y);
}
// How much of its history a pixel keeps: between the middles of tiles.
float kept_by_change(vec2 pixel) {
  ivec2 last = ivec2(change_tiles()) - 1;
  vec2 place = (pixel + 0.5) / float(kChangeTile) - 0.5, corner = floor(place), f = place - corner;
  float kept = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 offset = vec2(i & 1, i >> 1), near = mix(1.0 - f, f, offset);
    ivec2 tile = clamp(ivec2(corner + offset), ivec2(0), last);
    kept += near.x * near.y * uintBitsToFloat(history_words.at[change_word(uvec2(tile)) + 6u]);
  }
  return kept;
}
// Frames that a history still counts as.
float frames_after_change(float frames, float kept) {
  return frames == 0.0 || frame.still != 0u ? frames : max(frames * kept, kLeastKept);
}
#endif
