// From where on the camera's way a medium scattered light to it in past frames: for each block of pixels the moments of
// its distance, weighted by the light, a running mean. So distances can be guided in screen space, as the directions of
// paths that begin there are in the world's. What a path brings is divided by the density with which its distance was
// drawn, whatever these hold.
#ifndef FB_LIB_MEDIUM_DISTANCES
#define FB_LIB_MEDIUM_DISTANCES
#include "lib/pixel.glsl"
#include "lib/work.glsl"
#include "shared/medium.h"

const float kMostFrames = 32.0;    // of a running mean
const float kMostSurprise = 16.0;  // as many times the light so far a frame may bring to it, once it knows some frames
const float kLeastSpread = 0.05;   // of the mean distance
const float kFirstSpread = 0.5;    // likewise, of one frame

struct Distances {
  float light, first, second;  // mean light; that times its distance; times the distance's square
  float frames;
};

uint distances_at(uint half_of, uvec2 block) {
  uint rows = (frame.height + frame.medium_block - 1u) / frame.medium_block;
  return 2u * frame.width * frame.height + (half_of * rows + block.y) * frame.medium_width + block.x;
}

// Of the four blocks about a point of the former frame's picture.
Distances former_distances(vec2 pixel) {
  if (frame.distances_former == kNoIndex || !was_asked_for(kWorkMedium)) return Distances(0.0, 0.0, 0.0, 0.0);
  vec2 point = pixel / float(frame.medium_block) - 0.5, corner = floor(point), f = point - corner;
  ivec2 last = ivec2(frame.medium_width, (frame.height + frame.medium_block - 1u) / frame.medium_block) - 1;
  vec4 sum = vec4(0.0);
  uint i = 0u;
  do {
    vec2 offset = vec2(i & 1u, i >> 1u), along = mix(1.0 - f, f, offset);
    sum += along.x * along.y *
           radiance.at[distances_at(frame.distances_former, uvec2(clamp(ivec2(corner + offset), ivec2(0), last)))];
  } while (++i < 4u);
  return Distances(sum.x, sum.y, sum.z, sum.w);
}

// `start`: of the piece on which distances are drawn.
DistanceMix guided_by(Distances known, DistanceMix m, float start) {
  if (!(known.light > 0.0)) return m;
  float mean = known.first / known.light, square = known.second / known.light - mean * mean;
  float spread = mean * (kLeastSpread + kFirstSpread / max(known.frames, 1.0));
  return guided_distances(m, mean - start, sqrt(max(square, 0.0) + spread * spread), frame.fog_guided);
}

// `met`: light, and that times distance and its square, of this frame's paths.
void learn_distances(uvec2 block, Distances known, vec3 met) {
  float frames = min(known.frames + 1.0, kMostFrames);
  if (any(isnan(met)) || any(isinf(met))) met = vec3(0.0);  // it would stay
  if (known.frames >= 4.0 && known.light > 0.0) met *= min(1.0, kMostSurprise * known.light / max(met.x, 1e-30));
  vec3 sums = mix(vec3(known.light, known.first, known.second), met, 1.0 / frames);
  radiance.at[distances_at(frame.distances_now, block)] = vec4(sums, frames);
}
#endif
