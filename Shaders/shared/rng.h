// Random numbers on the device: one 32-bit PCG (RXS-M-XS, O'Neill 2014) a path, its state hashed from pixel, frame,
// sample and seed, so that any sample can be repeated alone.
#ifndef FB_SHARED_RNG_H
#define FB_SHARED_RNG_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_FN uint hash_u32(uint v) {
  uint state = v * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

FB_FN uint hash_combine(uint a, uint b) { return hash_u32(a ^ (hash_u32(b) + 0x9e3779b9u)); }

FB_FN uint rng_seed(uint pixel, uint frame, uint sample_index, uint seed) {
  return hash_combine(hash_combine(hash_combine(hash_u32(pixel), frame), sample_index), seed);
}

FB_FN uint rng_next(FB_INOUT(uint, state)) {
  state = state * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// Uniform in [0, 1), 24 bits.
FB_FN float rng_uniform(FB_INOUT(uint, state)) { return float(rng_next(state) >> 8u) * (1.0f / 16777216.0f); }

FB_NAMESPACE_END
#endif
