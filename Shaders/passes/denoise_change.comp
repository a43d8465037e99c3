// How much of the denoiser's history each tile keeps (shared/light_change.h).
// STEP 0: an invocation a tile sums up how its samples differ from the history's means, at one pixel of each block of
// light (SPARSE), or of each 2x2. 1: it decides with the 8 tiles about it, which tell a lamp's change, or the 48, which
// tell a fainter one of all light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_change.glsl"

#if STEP == 0
struct Sampled {
  float y;  // luminance of irradiance
  uvec2 pixel;
  uint name;  // of the surface
  vec3 normal;
  bool known;
};

#if SPARSE
Sampled sampled_at(uvec2 block) {
  uvec4 texel = history_quad(section(kSectionLight) + block.y * frame.light_width + block.x);
  float y = luminance_of(vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y & 0xffffu).x));
  return Sampled(y, light_pixel(block), texel.y >> 16u, unpack_surface_normal(texel.z), texel.z != 0u && texel.w == 0u);
}
uint samples_side() { return frame.light_block; }
#else
Sampled sampled_at(uvec2 block) {
  uvec2 pixel =
      min(2u * block + uvec2(frame.frame & 1u, (frame.frame >> 1u) & 1u), uvec2(frame.width, frame.height) - 1u);
  uint at = pixel.y * frame.width + pixel.x;
  uvec4 words = gbuffer_quad(at, 3u);
  vec3 ray = camera_direction(vec2(pixel) + 0.5);
  Reflector r = reflector(at, words, ray);
  Found found = found_at(at, r, ray);
  bool lit = max(r.factor.x, max(r.factor.y, r.factor.z)) > 0.0;
  return Sampled(luminance_of(found.own), pixel, surface_name(words), unpack_direction(words.x), lit && found.of_own);
}
uint samples_side() { return 2u; }
#endif

void main() {
  uvec2 tile = invocation_pixel();
  if (any(greaterThanEqual(tile, change_tiles()))) return;
  uint side = samples_side(), across = kChangeTile / side, samples = across * across;
  ChangeSums sums = ChangeSums(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  uint former = section(kSectionHistory + 1u - frame.history_parity), i = 0u;
  do {
    Sampled s = sampled_at(tile * kChangeTile / side + uvec2(i % across, i / across));
    bool inside = s.pixel.x < frame.width && s.pixel.y < frame.height;
    uvec2 pixel = inside ? s.pixel : uvec2(0u);
    vec4 motion = uintBitsToFloat(gbuffer_quad(pixel.y * frame.width + pixel.x, 4u));
    ivec2 before = ivec2(floor(vec2(pixel) + motion.xy + 0.5));
    inside = inside && motion.z > 0.0 && all(greaterThanEqual(before, ivec2(0))) && before.x < int(frame.width) &&
             before.y < int(frame.height);
    uvec4 texel = history_quad(former + (inside ? uint(before.y) * frame.width + uint(before.x) : 0u));
    float depth = unpack_surface_inverse_depth(texel.w) * motion.w, frames = float((texel.y >> 16u) & 0xffu);
    vec3 turned = unpack_surface_normal(texel.w) - s.normal;
    bool same = inside && frame.history_valid != 0u && s.known && frames > 0.0 && (texel.y >> 24u) == s.name &&
                abs(depth - 1.0) < 0.2 && dot(turned, turned) < 0.3;
    vec2 moments = unpackHalf2x16(texel.z);
    float difference = s.y - moments.x, counted = min(frames, kRememberedFrames);
    // The first frame since a cut counts as many, whose spread is not known: the variance is too small by what it
    // counts as, and by as much as one frame where it counts as one. Of the first alone nothing is known.
    float asked = min(counted, float(frame.history_age));
    same = same && (asked >= 2.0 || counted < 2.0);
    float variance = max(moments.y * moments.y - moments.x * moments.x, 0.0) * counted / max(asked - 1.0, 1.0);
    // What is not the same may be anything, not even a number.
    sums.difference += same ? difference : 0.0;
    sums.square += same ? difference * difference : 0.0;
    sums.level += same ? moments.x : 0.0;
    sums.variance += same ? variance * (SPARSE != 0 ? kInterpolated : 1.0) : 0.0;
    sums.remembered += same ? counted : 0.0;
    sums.samples += same ? 1.0 : 0.0;
  } while (++i < samples);
  uint to = change_word(tile) / 4u;
  history.at[to] = floatBitsToUint(vec4(sums.difference, sums.square, sums.level, sums.variance));
  history.at[to + 1u] =
      uvec4(floatBitsToUint(sums.remembered), floatBitsToUint(sums.samples), floatBitsToUint(1.0), 0u);
}
#else
// Tiles about this one, up to so many away.
ChangeSums sums_about(ivec2 tile, int radius) {
  ChangeSums sums = ChangeSums(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  int side = 2 * radius + 1, i = 0;
  do {
    ivec2 other = tile + ivec2(i % side, i / side) - radius;
    bool inside = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, ivec2(change_tiles())));
    sums = change_sum(sums, change_sums(uvec2(inside ? other : tile)), inside ? 1.0 : 0.0);
  } while (++i < side * side);
  return sums;
}

void main() {
  uvec2 tile = invocation_pixel();
  if (any(greaterThanEqual(tile, change_tiles()))) return;
  float kept = min(kept_of_change(sums_about(ivec2(tile), 1)), kept_of_change(sums_about(ivec2(tile), 3)));
  history_words.at[change_word(tile) + 6u] = floatBitsToUint(kept);
}
#endif
