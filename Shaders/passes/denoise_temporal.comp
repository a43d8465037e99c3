// First pass of the denoiser: this frame's irradiance joins what the same surface point had gathered in earlier frames
// (Schied 2017, Section 4.1): motion says where it was; what stood there counts if it had this id, normal and depth.
// Moments of the luminance give the variance of what was gathered.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_change.glsl"
#include "shared/baked_past.h"

struct History {
  vec3 irradiance;
  float frames;             // 0: none
  float mean, mean_square;  // of luminance
};

// `normal`: geometric, since nearest texels of a normal map differ from frame to frame under the camera's jitter.
// Bilinear over the four texels about `point` (index space) that belong to the same surface; where there is none, the
// eight around them: at an edge the moving rays meet now one side and now the other.
History find_history(vec2 point, float inverse_depth, vec2 slope, vec3 normal, uint id) {
  History h = History(vec3(0.0), 0.0, 0.0, 0.0);
  vec2 corner = floor(point), f = point - corner;
  uint from = section(kSectionHistory + 1u - frame.history_parity);
  float tolerance = 0.02 + 0.25 * (abs(slope.x) + abs(slope.y)), sum = 0.0;
  int taps = 4;
  for (int i = 0; i < taps; ++i) {
    int k = i - 4;
    vec2 offset = i < 4   ? vec2(i & 1, i >> 1)
                  : k < 4 ? vec2(k >> 1, 3 * (k & 1) - 1)
                          : vec2(3 * (k & 1) - 1, (k - 4) >> 1);
    vec2 tap = corner + offset;
    bool inside = all(greaterThanEqual(tap, vec2(0.0))) && tap.x < float(frame.width) && tap.y < float(frame.height);
    uvec4 texel = history_quad(from + (inside ? uint(tap.y) * frame.width + uint(tap.x) : 0u));
    float expected = inverse_depth * max(1.0 + dot(slope, tap - point), 0.01);
    vec3 turned = unpack_surface_normal(texel.w) - normal;
    bool same = inside && (texel.y >> 24u) == id && ((texel.y >> 16u) & 0xffu) != 0u && dot(turned, turned) < 0.3 &&
                abs(unpack_surface_inverse_depth(texel.w) - expected) < tolerance * expected;
    vec2 weights = mix(1.0 - f, f, offset);
    float weight = same ? (i < 4 ? weights.x * weights.y : 1.0) : 0.0;
    vec2 moments = unpackHalf2x16(texel.z);
    h.irradiance += weight * vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y & 0xffffu).x);
    h.frames += weight * float((texel.y >> 16u) & 0xffu);
    h.mean += weight * moments.x;
    h.mean_square += weight * moments.y * moments.y;
    sum += weight;
    if (i == 3 && sum < 0.02) taps = 12;
  }
  if (frame.history_valid == 0u || sum == 0.0) return History(vec3(0.0), 0.0, 0.0, 0.0);
  float scale = 1.0 / sum;
  return History(h.irradiance * scale, h.frames * scale, h.mean * scale, h.mean_square * scale);
}

// A store costs as much as a fetch, word by word: what the wavelet's first level writes anyway is left to it, and what
// its levels hand on unchanged is written to both of their sections now.
void write_texels(uint at, uvec4 filter_texel, uint moments, uint surface) {
  history.at[section(kSectionFilter) + at] = filter_texel;
  uint other = (section(kSectionFilter + 1u) + at) * 4u;
  history_words.at[other + 2u] = filter_texel.z;
  history_words.at[other + 3u] = filter_texel.w;
  uint own = (section(kSectionHistory + frame.history_parity) + at) * 4u;
  history_words.at[own + 2u] = moments;
  history_words.at[own + 3u] = surface;
}

// Frames that count after the last level of the frame before has said how much of the history there it trusts.
float kept_frames(float frames, vec2 point) {
  uvec2 p = uvec2(clamp(point + 0.5, vec2(0.0), vec2(frame.width, frame.height) - 1.0));
  float kept = float(picture_texel(p.y * frame.width + p.x).y >> 16u) / 255.0;
  return frames < 4.0 || frame.still != 0u ? frames : max(frames * kept, 4.0);
}

// This frame's.
struct Light {
  vec3 irradiance;
  bool known;    // or a guess
  bool sampled;  // not a guess
};

#if SPARSE
// Light at a pixel from the samples of the four blocks about it, each by its distance and if it is of this surface
// (joint bilateral upsampling, Kopf 2007); its own sample alone where it has one.
const float kGuess = 1e-4;         // what a guess counts beside a sample
const float kOtherSurface = 1e-3;  // what a sample of another surface counts, where there is none of this

Light light_about(uvec2 pixel, float inverse_depth, vec2 slope, vec3 normal, uint id) {
  float side = float(frame.light_block);
  vec2 place = (vec2(pixel) - vec2(frame.light_x, frame.light_y)) / side, corner = floor(place), f = place - corner;
  float tolerance = 0.02 + 0.25 * (abs(slope.x) + abs(slope.y)), weights = 0.0;
  ivec2 blocks = ivec2(frame.light_width, (frame.height + frame.light_block - 1u) / frame.light_block);
  vec3 sum = vec3(0.0);
  bool sampled = false;
  for (uint i = 0u; i < 4u; ++i) {
    vec2 offset = vec2(i & 1u, i >> 1u);
    ivec2 block = ivec2(corner + offset);
    bool inside = all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, blocks));
    uvec4 texel =
        history_quad(section(kSectionLight) + (inside ? uint(block.y) * frame.light_width + uint(block.x) : 0u));
    float expected = inverse_depth * max(1.0 + dot(slope, (offset - f) * side), 0.01);
    vec3 turned = unpack_surface_normal(texel.z) - normal;
    bool same = (texel.y >> 16u) == id && dot(turned, turned) < 0.3 &&
                abs(unpack_surface_inverse_depth(texel.z) - expected) < tolerance * expected;
    vec2 near = mix(1.0 - f, f, offset);
    bool there = inside && texel.z != 0u, guessed = texel.w != 0u;
    float weight = there ? max(near.x * near.y, 1e-7) * (same ? 1.0 : kOtherSurface) * (guessed ? kGuess : 1.0) : 0.0;
    sampled = sampled || (there && !guessed);
    sum += weight * vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y & 0xffffu).x);
    weights += weight;
  }
  return Light(sum / max(weights, 1e-20), weights > 0.0, sampled);
}
#endif

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  uvec4 words = gbuffer_quad(at, 3u);
  vec4 motion = uintBitsToFloat(gbuffer_quad(at, 4u));
  vec3 ray = camera_direction(vec2(pixel) + 0.5);
  Reflector r = reflector(at, words, ray);
  uint id = surface_name(words);
  vec3 geometric = unpack_direction(words.x);
  vec2 slope = plane_slope(geometric, ray);
  float inverse_depth = at_middle(1.0 / max(motion.z, 1e-3), slope),
        depth_before = frame.still != 0u ? motion.z : motion.w;
  vec2 point = vec2(pixel) + (frame.still != 0u ? vec2(0.0) : motion.xy);
  History h = find_history(point, at_middle(1.0 / max(depth_before, 1e-3), slope), slope, geometric, id);
  h.frames = frames_after_change(kept_frames(h.frames, point), kept_by_change(vec2(pixel)));
#if SPARSE
  Light light = light_about(pixel, inverse_depth, slope, geometric, id);
#else
  // A black texel says nothing of the light on it; it keeps what its surroundings found.
  Found found = found_at(at, r, ray);
  Light light = Light(found.own, max(r.factor.x, max(r.factor.y, r.factor.z)) > 0.0, found.of_own);
#endif
  vec3 x = light.irradiance;
  bool reflects = light.known && (light.sampled || h.frames == 0.0);
  float y = luminance_of(x);
  bool known = motion.z > 0.0 && (reflects || h.frames > 0.0);

  // The first frame counts more frames than there were; but not where it had a past made for it.
  bool young = frame.history_age < 3u && (frame.baked_past == 0.0 || h.frames < frame.baked_past + 2.0);
  float gain = float(frame.history_gain), frames = min(h.frames + (reflects ? gain : 0.0), float(kMaxHistory));
  float least = gain / max(frames, gain);
  float weight = frame.still != 0u ? least : max(least, frame.svgf_alpha);
  float moments_weight = max(least, frame.svgf_moments_alpha);
  float spread = weight;  // of the mean over that of a sample
  if (!reflects) weight = moments_weight = 0.0;
  if (frame.firefly > 0.0 && h.frames >= 4.0 && !young) {
    float cut = firefly_cut(y, h.mean, h.mean_square, frame.firefly);
    x *= cut;
    y *= cut;
  }
  vec3 irradiance = mix(h.irradiance, x, weight);
  float mean = mix(h.mean, y, moments_weight), mean_square = mix(h.mean_square, y * y, moments_weight);
  // Too few frames to tell their spread: whatever the neighbours have on this surface is as good.
  float variance = max(mean_square - mean * mean, 0.0);
  if (frame.baked_past > 0.0 && frame.history_age < kBakedTrust)
    variance = variance_with_past(variance, mean, frames, frame.baked_past);
  float deviation = min(sqrt(variance * spread), kMaxDeviation);
  if (frames < 4.0 || young) deviation = kUnknownDeviation;

  float ahead = h.frames == 0.0 ? 0.0 : mean - luminance_of(irradiance);
  float random = float(rng_seed(at, frame.frame, 0u, 0u) >> 8u) * (1.0 / 16777216.0);
  uvec4 filter_texel = uvec4(pack_rgb9e5(irradiance, random), packHalf2x16(vec2(deviation, ahead)),
                             pack_surface(inverse_depth, unpack_direction(words.y)),
                             uint(frames + 0.5) | (id << 8u) | (pack_coarse_normal(geometric) << 16u) |
                                 (is_liquid(words) ? kFilterLiquid : 0u));
  uint moments = packHalf2x16(vec2(mean, sqrt(mean_square)));
  if (known)
    write_texels(at, filter_texel, moments, pack_surface(inverse_depth, geometric));
  else
    write_texels(at, uvec4(0u), 0u, 0u);
}
