// Anti-aliasing over time of the finished picture (Karis 2014): the camera's rays move within their pixels from
// frame to frame; the picture so far is carried along by motion, held to the range of colours about the pixel now, and
// this frame joins it with a small weight.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/denoise.glsl"
#include "shared/rng.h"

vec3 unpack_rgb10(uint u) { return vec3(u & 1023u, (u >> 10u) & 1023u, u >> 20u) * (1.0 / 1023.0); }
// Rounded at random, so that small steps towards a new colour are not lost.
uint pack_rgb10(vec3 c, uint rng) {
  vec3 r = vec3(rng & 1023u, (rng >> 10u) & 1023u, (rng >> 20u) & 1023u) * (1.0 / 1024.0);
  uvec3 u = uvec3(min(clamp(c, 0.0, 1.0) * 1023.0 + r, 1023.0));
  return u.x | (u.y << 10u) | (u.z << 20u);
}
vec3 ldr_at(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(frame.width, frame.height) - 1);
  return unpackUnorm4x8(ldr.at[uint(p.y) * frame.width + uint(p.x)]).rgb;
}
vec3 shown_before(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(frame.width, frame.height) - 1);
  return unpack_rgb10(history_words.at[shown_word(1u - frame.history_parity, uint(p.y) * frame.width + uint(p.x))]);
}

// The parabola through three texels each way: keeps edges sharp that are resampled every frame.
vec3 parabola_weights(float f) { return vec3(0.5 * f * (f - 1.0), 1.0 - f * f, 0.5 * f * (f + 1.0)); }
vec3 resample(vec2 point) {
  vec2 nearest = floor(point + 0.5);
  vec3 wx = parabola_weights(point.x - nearest.x), wy = parabola_weights(point.y - nearest.y);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i) sum += wx[i % 3] * wy[i / 3] * shown_before(ivec2(nearest) + ivec2(i % 3, i / 3) - 1);
  return sum;
}

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  vec3 color = ldr_at(ivec2(pixel));
  if (frame.debug_view == 0u && frame.history_valid != 0u) {
    vec3 sum = color, squares = color * color;
    for (int i = 0; i < 4; ++i) {
      int side = 2 * (i & 1) - 1;
      vec3 c = ldr_at(ivec2(pixel) + (i < 2 ? ivec2(side, 0) : ivec2(0, side)));
      sum += c;
      squares += c * c;
    }
    vec3 mean = sum / 5.0, spread = sqrt(max(squares / 5.0 - mean * mean, 0.0)) * 1.25 + 1.0 / 255.0;
    vec2 motion = frame.still != 0u ? vec2(0.0) : uintBitsToFloat(gbuffer_quad(at, 4u).xy);
    vec2 point = vec2(pixel) + motion;
    bool inside = all(greaterThan(point, vec2(-0.5))) && point.x < float(frame.width) - 0.5 && point.y < float(frame.height) - 0.5;
    vec3 before = clamp(resample(point), mean - spread, mean + spread);
    // What has just come into sight has no picture before: what there was, held to the colours about, keeps its edges smooth.
    float frames = float((history_words.at[(section(kSectionHistory + frame.history_parity) + at) * 4u + 1u] >> 16u) & 0xffu);
    if (inside) color = mix(before, color, frames > 0.0 ? clamp(1.0 / frames, 0.1, 0.5) : 0.2);
  }
  history_words.at[shown_word(frame.history_parity, at)] = pack_rgb10(color, hash_combine(at, frame.frame));
  smoothed.at[at] = packUnorm4x8(vec4(color, 1.0));
}
