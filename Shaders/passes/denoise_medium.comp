// Light that the medium scatters to the camera, denoised apart from surfaces, at blocks of pixels. It has no surface to follow: a
// block's place is where, in the mean, light scatters on the way to what is behind.
// STEP 0: this frame's samples join what was gathered where that place was. 1: a level of the wavelet, as in denoise_wavelet.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/medium_history.glsl"
#include "shared/color.h"

#if STEP == 0
MediumLight gathered(vec2 pixel, float near) {
  vec2 point = pixel / float(frame.medium_block) - 0.5, corner = floor(point), f = point - corner;
  ivec2 size = medium_size();
  uint from = medium_slot(1u - frame.history_parity);
  MediumLight sum = MediumLight(vec3(0.0), 0.0, 0.0, 0.0, 0.0);
  float weights = 0.0;
  for (uint i = 0u; i < 4u; ++i) {
    vec2 offset = vec2(i & 1u, i >> 1u);
    ivec2 b = ivec2(corner + offset);
    bool inside = all(greaterThanEqual(b, ivec2(0))) && all(lessThan(b, size));
    MediumLight m = unpack_medium(history_quad(from + (inside ? uint(b.y * size.x + b.x) : 0u)));
    vec2 along = mix(1.0 - f, f, offset);
    float weight = inside && m.frames > 0.0 ? along.x * along.y * medium_alike(near, m.near) : 0.0;
    sum.light += weight * m.light;
    sum.frames += weight * m.frames;
    sum.mean += weight * m.mean;
    sum.mean_square += weight * m.mean_square;
    weights += weight;
  }
  if (frame.history_valid == 0u || !(weights > 0.02)) return MediumLight(vec3(0.0), 0.0, near, 0.0, 0.0);
  float scale = 1.0 / weights;
  return MediumLight(sum.light * scale, sum.frames * scale, near, sum.mean * scale, sum.mean_square * scale);
}

void main() {
  uvec2 block = invocation_pixel();
  ivec2 size = medium_size();
  if (block.x >= uint(size.x) || block.y >= uint(size.y)) return;
  uvec2 pixel = min(medium_pixel(block), uvec2(frame.width, frame.height) - 1u);
  bool sampled = pixel == medium_pixel(block);
  uint at = pixel.y * frame.width + pixel.x;
  vec3 ray = camera_direction(vec2(pixel) + 0.5);
  MediumThere there = medium_there(at, ray);
  vec3 factor = there.factor;
  float distance = there.distance;
  // Where nothing scatters nothing is known of the light.
  sampled = sampled && max(factor.x, max(factor.y, factor.z)) > 0.0;
  vec3 x = sampled ? checked_irradiance(demodulate(radiance.at[frame.width * frame.height + at].rgb, factor)) : vec3(0.0);
  vec3 before = previous_pixel(frame.camera_position.xyz + normalize(ray) * distance);
  vec2 point = frame.still != 0u || before.z <= 0.0 ? vec2(pixel) + 0.5 : before.xy;
  MediumLight m = gathered(point, log(max(distance, 1e-6)));
  float gain = float(frame.history_gain), frames = min(m.frames + (sampled ? gain : 0.0), float(kMaxHistory));
  float least = gain / max(frames, gain), weight = sampled ? frame.still != 0u ? least : max(least, frame.svgf_alpha) : 0.0;
  float y = luminance(x);
  m.light = mix(m.light, x, weight);
  m.mean = mix(m.mean, y, weight);
  m.mean_square = mix(m.mean_square, y * y, weight);
  m.frames = frames;
  uvec4 texel = pack_medium(m);
  uint to = block.y * uint(size.x) + block.x;
  history.at[medium_slot(frame.history_parity) + to] = texel;
  history.at[medium_slot(2u) + to] = texel;
}
#else
layout(push_constant) uniform Level {
  ivec2 lattice;  // this level's step, in blocks
  uint source, target;
} level;

void main() {
  uvec2 block = invocation_pixel();
  ivec2 size = medium_size();
  if (block.x >= uint(size.x) || block.y >= uint(size.y)) return;
  uint source = medium_slot(level.source), at = block.y * uint(size.x) + block.x;
  MediumLight c = unpack_medium(history_quad(source + at));
  MediumLight taps[4];
  float spread = max(c.mean_square - c.mean * c.mean, 0.0), pooled = 1.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = (i & 1) == 0 ? level.lattice : ivec2(-level.lattice.y, level.lattice.x);
    ivec2 b = clamp(ivec2(block) + (i < 2 ? offset : -offset), ivec2(0), size - 1);
    taps[i] = unpack_medium(history_quad(source + uint(b.y * size.x + b.x)));
    spread += max(taps[i].mean_square - taps[i].mean * taps[i].mean, 0.0);
    pooled += 1.0;
  }
  // Standard deviation of what was gathered, not of a sample.
  float weight_of_frame = max(1.0 / max(c.frames, 1.0), frame.svgf_alpha);
  float deviation = sqrt(spread / pooled * weight_of_frame), y = luminance(c.light);
  // The first frame counts as several, which say nothing of their spread.
  float scale = c.frames >= 4.0 && frame.history_age >= 3u ? 1.0 / (frame.sigma_luminance * deviation + 1e-4 + 0.02 * y) : 0.0;
  vec3 sum = c.light;
  float weights = 1.0;
  for (int i = 0; i < 4; ++i) {
    float weight = taps[i].frames > 0.0 ? medium_alike(c.near, taps[i].near) * exp(-abs(luminance(taps[i].light) - y) * scale) : 0.0;
    sum += weight * taps[i].light;
    weights += weight;
  }
  c.light = sum / weights;
  history.at[medium_slot(level.target) + at] = pack_medium(c);
}
#endif
