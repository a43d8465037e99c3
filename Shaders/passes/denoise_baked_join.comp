// A frame without a past begins with the map's baked light, as r_baked_past frames of history beside this frame's
// samples (shared/baked_past.h). STEP 0: an invocation a tile sums up both. 1: each pixel joins its samples to its
// baked light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_change.glsl"
#include "shared/baked_past.h"

uint own_history(uint at) { return (section(kSectionHistory + frame.history_parity) + at) * 4u; }
// The tile's words, which the test for changing light is done with in this frame.
uint sums_word(uvec2 tile) { return change_word(tile); }

#if STEP == 0
void main() {
  uvec2 tile = invocation_pixel();
  if (any(greaterThanEqual(tile, change_tiles()))) return;
  BakedSums sums = BakedSums(0.0, 0.0, 0.0);
  uint i = 0u;
  do {
    uvec2 pixel = tile * kChangeTile + uvec2(i % kChangeTile, i / kChangeTile);
    bool inside = pixel.x < frame.width && pixel.y < frame.height;
    uint at = inside ? pixel.y * frame.width + pixel.x : 0u;
    uint word = history_words.at[own_history(at)];
    uvec4 texel = history_quad(section(kSectionFilter) + at);
    bool counts = inside && word != kNoBakedPast && texel.z != 0u;
    float y = counts ? luminance_of(unpack_rgb9e5(texel.x)) : 0.0;
    sums.samples += y;
    sums.baked += counts ? luminance_of(unpack_rgb9e5(word)) : 0.0;
    sums.squares += y * y;
  } while (++i < kChangeTile * kChangeTile);
  history_words.at[sums_word(tile)] = floatBitsToUint(sums.samples);
  history_words.at[sums_word(tile) + 1u] = floatBitsToUint(sums.baked);
  history_words.at[sums_word(tile) + 2u] = floatBitsToUint(sums.squares);
}
#else
// Over the tiles about a pixel, the nearer the more.
BakedSums sums_about(uvec2 pixel) {
  vec2 place = (vec2(pixel) + 0.5) / float(kChangeTile) - 0.5;
  ivec2 tile = ivec2(pixel / kChangeTile), last = ivec2(change_tiles()) - 1;
  BakedSums sums = BakedSums(0.0, 0.0, 0.0);
  int i = 0;
  do {
    ivec2 other = tile + ivec2(i % 3, i / 3) - 1;
    vec2 near = max(1.5 - abs(vec2(other) - place), 0.0);
    float weight = other == clamp(other, ivec2(0), last) ? near.x * near.y : 0.0;
    uint word = sums_word(uvec2(clamp(other, ivec2(0), last)));
    sums.samples += weight * uintBitsToFloat(history_words.at[word]);
    sums.baked += weight * uintBitsToFloat(history_words.at[word + 1u]);
    sums.squares += weight * uintBitsToFloat(history_words.at[word + 2u]);
  } while (++i < 9);
  return sums;
}

// The moments stay those of samples, by which later frames tell whether the light has changed.
void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, word = history_words.at[own_history(at)];
  uvec4 texel = history_quad(section(kSectionFilter) + at);
  if (word == kNoBakedPast || texel.z == 0u) return;  // nothing to filter
  vec3 past = unpack_rgb9e5(word) * baked_factor(sums_about(pixel));
  float own = float(texel.w & 0xffu), share = share_beside_past(own, frame.baked_past), y = luminance_of(past);
  vec2 moments = unpackHalf2x16(history_words.at[own_history(at) + 2u]);
  float apart = moments.x - y,
        variance = variance_with_past(apart * apart, y, own + frame.baked_past, frame.baked_past);
  uint others = texel.w & ~0xffu, frames = uint(min(own + frame.baked_past, float(kMaxHistory)) + 0.5);
  vec3 irradiance = mix(past, unpack_rgb9e5(texel.x), share);
  uint deviation = packHalf2x16(vec2(min(sqrt(variance * share), kMaxDeviation), 0.0));
  history.at[section(kSectionFilter) + at] = uvec4(pack_rgb9e5(irradiance, 0.5), deviation, texel.z, others | frames);
  history_words.at[(section(kSectionFilter + 1u) + at) * 4u + 3u] = others | frames;
}
#endif
