// Anti-aliasing over time of the finished picture (Karis 2014): the camera's rays move within their pixels from
// frame to frame; the picture so far is carried along by motion, held to the range of colours about the pixel now, and
// this frame joins it with a small weight. UPSCALES: the picture so far has the output's pixels, which are smaller; a
// frame's sample joins those that are near it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/denoise.glsl"
#include "shared/rng.h"

const float kFramesKept = UPSCALES != 0 ? 16.0 : 9.0;  // what the picture so far counts, at most

vec3 unpack_rgb10(uint u) { return vec3(u & 1023u, (u >> 10u) & 1023u, u >> 20u) * (1.0 / 1023.0); }
// Rounded at random, so that small steps towards a new colour are not lost.
uint pack_rgb10(vec3 c, uint rng) {
  vec3 r = vec3(rng & 1023u, (rng >> 10u) & 1023u, (rng >> 20u) & 1023u) * (1.0 / 1024.0);
  uvec3 u = uvec3(min(clamp(c, 0.0, 1.0) * 1023.0 + r, 1023.0));
  return u.x | (u.y << 10u) | (u.z << 20u);
}
ivec2 rendered(ivec2 p) { return clamp(p, ivec2(0), ivec2(frame.width, frame.height) - 1); }
uint rendered_at(ivec2 p) {
  p = rendered(p);
  return uint(p.y) * frame.width + uint(p.x);
}
vec3 ldr_at(ivec2 p) { return unpackUnorm4x8(ldr.at[rendered_at(p)]).rgb; }
vec3 shown_before(ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(frame.smooth_width, frame.smooth_height) - 1);
  return unpack_rgb10(
      history_words.at[shown_word(1u - frame.history_parity, uint(p.y) * frame.smooth_width + uint(p.x))]);
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

// What this frame says of a pixel of the picture.
struct Now {
  vec3 color;
  float weight, usual;  // of the colour; its mean over the frames
  vec3 mean, spread;    // of the colours about
  vec2 motion;          // in pixels of the picture
  float frames;         // in the history of the surface; 0: it has none
};

float frames_at(uint at) {
  return float((history_words.at[(section(kSectionHistory + frame.history_parity) + at) * 4u + 1u] >> 16u) & 0xffu);
}
vec2 motion_at(uint at) { return frame.still != 0u ? vec2(0.0) : uintBitsToFloat(gbuffer_quad(at, 4u).xy); }
vec3 spread_of(vec3 mean, vec3 mean_square) { return sqrt(max(mean_square - mean * mean, 0.0)) * 1.25 + 1.0 / 255.0; }

#if UPSCALES
// A sample counts by its distance: a Gaussian as wide as a pixel of the picture. The less is known of a surface, the
// more it counts at all pixels between samples, which would else differ from those at samples.
const float kNarrow = 3.3;

Now frame_at(uvec2 pixel) {
  vec2 size = vec2(frame.width, frame.height), up = vec2(frame.smooth_width, frame.smooth_height) / size;
  vec2 place = (vec2(pixel) + 0.5) / up;
  vec2 among = place - 0.5 - vec2(frame.jitter_x, frame.jitter_y), nearest = floor(among + 0.5);
  // What is in front moves the edge, and an edge's picture is as old as what it is the edge of.
  vec4 front = vec4(0.0);
  float closest = -1.0;
  uint front_at = 0u;
  for (int i = 0; i < 9; ++i) {
    uint at = rendered_at(ivec2(nearest) + ivec2(i % 3, i / 3) - 1);
    vec4 motion = uintBitsToFloat(gbuffer_quad(at, 4u));
    float inverse_depth = motion.z > 0.0 ? 1.0 / motion.z : 0.0;
    front = inverse_depth > closest ? motion : front;
    front_at = inverse_depth > closest ? at : front_at;
    closest = max(closest, inverse_depth);
  }
  float frames = max(frames_at(rendered_at(ivec2(place))), frames_at(front_at)), between = 1.0 / max(frames, 1.0);
  Now now = Now(vec3(0.0), 0.0, 3.1415927 / (kNarrow * up.x * up.y), vec3(0.0), vec3(0.0), front.xy * up, frames);
  vec3 squares = vec3(0.0);
  float moments = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec2 at = nearest + vec2(i % 3 - 1, i / 3 - 1);
    vec2 away = (among - at) * up;
    vec2 near = max(1.0 - abs(among - at), 0.0);
    float weight = exp2(-1.442695 * kNarrow * dot(away, away)) + between * near.x * near.y;
    vec3 c = ldr_at(ivec2(at));
    now.weight += weight;
    now.color += weight * c;
    float about = exp2(-1.442695 * dot(among - at, among - at));
    moments += about;
    now.mean += about * c;
    squares += about * c * c;
  }
  if (frame.still != 0u) now.motion = vec2(0.0);
  now.color /= now.weight;
  now.mean /= moments;
  now.spread = spread_of(now.mean, squares / moments);
  return now;
}
#else
Now frame_at(uvec2 pixel) {
  uint at = pixel.y * frame.width + pixel.x;
  vec3 color = ldr_at(ivec2(pixel)), sum = color, squares = color * color;
  vec4 motion = uintBitsToFloat(gbuffer_quad(at, 4u));
  float closest = motion.z > 0.0 ? 1.0 / motion.z : 0.0;
  uint front = at;
  for (int i = 0; i < 4; ++i) {
    int side = 2 * (i & 1) - 1;
    ivec2 p = ivec2(pixel) + (i < 2 ? ivec2(side, 0) : ivec2(0, side));
    vec3 c = ldr_at(p);
    sum += c;
    squares += c * c;
    vec4 other = uintBitsToFloat(gbuffer_quad(rendered_at(p), 4u));
    float inverse_depth = other.z > 0.0 ? 1.0 / other.z : 0.0;
    if (inverse_depth > closest * 1.1) {
      closest = inverse_depth;
      motion = other;
      front = rendered_at(p);
    }
  }
  vec2 moved = frame.still != 0u ? vec2(0.0) : motion.xy;
  return Now(color, 1.0, 1.0, sum / 5.0, spread_of(sum / 5.0, squares / 5.0), moved,
             max(frames_at(at), frames_at(front)));
}
#endif

void main() {
  uvec2 pixel = invocation_pixel(), size = uvec2(frame.smooth_width, frame.smooth_height);
  if (pixel.x >= size.x || pixel.y >= size.y) return;
  uint at = pixel.y * size.x + pixel.x;
  Now now = frame_at(pixel);
  vec3 color = now.color;
  if (frame.debug_view == 0u && frame.history_valid != 0u) {
    vec2 point = vec2(pixel) + now.motion;
    bool inside = all(greaterThan(point, vec2(-0.5))) && all(lessThan(point, vec2(size) - 0.5));
    vec3 carried = resample(point), before = clamp(carried, now.mean - now.spread, now.mean + now.spread);
    vec3 off = abs(carried - before) / now.spread;
    // What has just come into sight has no picture before: what there was, held to the colours about, keeps its edges
    // smooth.
    float kept = (now.frames > 0.0 ? clamp(now.frames - 1.0, 1.0, kFramesKept) : 4.0) * now.usual /
                 (1.0 + max(off.x, max(off.y, off.z)));
    if (inside) color = mix(before, color, now.weight / (now.weight + kept));
  }
  history_words.at[shown_word(frame.history_parity, at)] = pack_rgb10(color, hash_combine(at, frame.frame));
  smoothed.at[at] = packUnorm4x8(vec4(color, 1.0));
}
