// Light that is denoised apart from pixels' own surfaces, at blocks of pixels (lib/layers.glsl).
// SECOND: on second surfaces, whose own motion its history follows; else what a medium scatters. That has no surface to
// follow: a block's place is where, in the mean, light scatters on the way to what is behind. STEP 0: this frame's
// samples join what was gathered where that place was. 1: a level of the wavelet, as in denoise_wavelet.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layers.glsl"
#include "lib/light_change.glsl"
#include "lib/work.glsl"

#if SECOND
const uint kThisWork = kWorkSecond;
Layer this_layer() { return second_layer(); }
#else
const uint kThisWork = kWorkMedium;
Layer this_layer() { return medium_layer(); }
#endif

#if STEP == 0
LayerLight gathered(Layer layer, vec2 pixel, uint place) {
  vec2 point = pixel / float(layer.block) - 0.5, corner = floor(point), f = point - corner;
  uint from = layer_slot(layer, 1u - frame.history_parity);
  LayerLight sum = LayerLight(vec3(0.0), 0.0, 0u, 0.0, 0.0);
  float weights = 0.0;
  for (uint i = 0u; i < 4u; ++i) {
    vec2 offset = vec2(i & 1u, i >> 1u);
    ivec2 b = ivec2(corner + offset);
    bool inside = all(greaterThanEqual(b, ivec2(0))) && all(lessThan(b, layer.size));
    LayerLight m = unpack_layer(history_quad(from + (inside ? uint(b.y * layer.size.x + b.x) : 0u)));
    vec2 along = mix(1.0 - f, f, offset);
    float weight = inside && m.frames > 0.0 ? along.x * along.y * layer_alike(place, m.place) : 0.0;
    sum.light += weight * m.light;
    sum.frames += weight * m.frames;
    sum.mean += weight * m.mean;
    sum.mean_square += weight * m.mean_square;
    weights += weight;
  }
  if (frame.history_valid == 0u || !was_asked_for(kThisWork) || !(weights > 0.02))
    return LayerLight(vec3(0.0), 0.0, 0u, 0.0, 0.0);
  float scale = 1.0 / weights;
  return LayerLight(sum.light * scale, sum.frames * scale, 0u, sum.mean * scale, sum.mean_square * scale);
}

// This frame's light, and where in the former picture its place was.
struct Sampled {
  vec3 light;
  bool known, guessed;  // guessed: nothing was sampled, but this is better than black
  vec2 point;
};
#if SECOND
Sampled sampled_at(uvec2 pixel, uint at, vec3 ray, LayerThere there) {
  Found found = found_at(at, reflector(at, gbuffer_quad(at, 3u), ray), ray);
  return Sampled(found.second, found.of_second, true, vec2(pixel) + 0.5 + second_at(at).motion);
}
#else
Sampled sampled_at(uvec2 pixel, uint at, vec3 ray, LayerThere there) {
  vec3 before = previous_pixel(frame.camera_position.xyz + ray * there.depth);
  vec3 light = checked_irradiance(demodulate(radiance.at[frame.width * frame.height + at].rgb, there.factor));
  return Sampled(light, true, false, before.z > 0.0 ? before.xy : vec2(pixel) + 0.5);
}
#endif

void main() {
  uvec2 block = invocation_pixel();
  Layer layer = this_layer();
  if (block.x >= uint(layer.size.x) || block.y >= uint(layer.size.y)) return;
#if SECOND
  uvec2 lit = light_pixel(block);
#else
  uvec2 lit = medium_pixel(block);
#endif
  uvec2 pixel = min(lit, uvec2(frame.width, frame.height) - 1u);
  uint at = pixel.y * frame.width + pixel.x;
  vec3 ray = camera_direction(vec2(pixel) + 0.5);
#if SECOND
  LayerThere there = second_there(at, ray);
#else
  LayerThere there = medium_there(at, ray);
#endif
  // Where the layer has nothing nothing is known of its light.
  bool present = pixel == lit && max(there.factor.x, max(there.factor.y, there.factor.z)) > 0.0;
  Sampled x = sampled_at(pixel, at, ray, there);
  bool still = frame.still != 0u;
  uint place = place_of(there);  // hardly farther or nearer a frame ago
  LayerLight m = gathered(layer, still ? vec2(pixel) + 0.5 : x.point, place);
  m.frames = frames_after_change(m.frames, kept_by_change(vec2(pixel)));
  bool known = present && (x.known || (x.guessed && m.frames == 0.0));
  float gain = float(frame.history_gain), frames = min(m.frames + (known ? gain : 0.0), float(kMaxHistory));
  float least = gain / max(frames, gain), weight = known ? still ? least : max(least, frame.svgf_alpha) : 0.0;
  float y = luminance_of(x.light);
  m.light = mix(m.light, x.light, weight);
  m.mean = mix(m.mean, y, weight);
  m.mean_square = mix(m.mean_square, y * y, weight);
  m.frames = frames;
  m.place = place;
  uvec4 texel = pack_layer(m);
  uint to = block.y * uint(layer.size.x) + block.x;
  history.at[layer_slot(layer, frame.history_parity) + to] = texel;
  history.at[layer_slot(layer, 2u) + to] = texel;
}
#else
layout(push_constant) uniform Level {
  ivec2 lattice;  // this level's step, in blocks
  uint source, target;
}
level;

void main() {
  uvec2 block = invocation_pixel();
  Layer layer = this_layer();
  if (block.x >= uint(layer.size.x) || block.y >= uint(layer.size.y)) return;
  uint source = layer_slot(layer, level.source), at = block.y * uint(layer.size.x) + block.x;
  LayerLight c = unpack_layer(history_quad(source + at));
  LayerLight taps[4];
  float spread = max(c.mean_square - c.mean * c.mean, 0.0), pooled = 1.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = (i & 1) == 0 ? level.lattice : ivec2(-level.lattice.y, level.lattice.x);
    ivec2 b = clamp(ivec2(block) + (i < 2 ? offset : -offset), ivec2(0), layer.size - 1);
    taps[i] = unpack_layer(history_quad(source + uint(b.y * layer.size.x + b.x)));
    spread += max(taps[i].mean_square - taps[i].mean * taps[i].mean, 0.0);
    pooled += 1.0;
  }
  // Standard deviation of what was gathered, not of a sample.
  float weight_of_frame = max(1.0 / max(c.frames, 1.0), frame.svgf_alpha);
  float deviation = sqrt(spread / pooled * weight_of_frame), y = luminance_of(c.light);
  // The first frame counts as several, which say nothing of their spread.
  float scale = c.frames >= 4.0 && frame.history_age >= 3u
                    ? 1.0 / (frame.sigma_luminance * deviation + 1e-4 + 0.02 * abs(y))
                    : 0.0;
  // A block that has nothing is filled by those about it: some pixel of it may have more than the one that was asked.
  // One whose history was given up, and that was not asked since, still has that light (frames_after_change()).
  bool empty = c.frames == 0.0;
  float weights = empty ? 1e-20 : 1.0;
  vec3 sum = weights * c.light;
  for (int i = 0; i < 4; ++i) {
    float weight = taps[i].frames > 0.0 ? (empty ? 1.0 : layer_alike(c.place, taps[i].place)) *
                                              exp(-abs(luminance_of(taps[i].light) - y) * scale)
                                        : 0.0;
    sum += weight * taps[i].light;
    weights += weight;
  }
  c.light = sum / weights;
  c.frames = empty && weights > 1e-20 ? 1.0 : c.frames;
  history.at[layer_slot(layer, level.target) + at] = pack_layer(c);
}
#endif
