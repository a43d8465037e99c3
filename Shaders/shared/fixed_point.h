// Sums of real numbers by atomic additions of integers: they are the same in any order of threads. A number becomes a
// multiple of a step, rounded up or down at random, so that the mean of many is right however small they are against a
// step. Numbers below zero are in two's complement, and a uint that is added to modulo 2^32 is the sum of both signs.
#ifndef FB_SHARED_FIXED_POINT_H
#define FB_SHARED_FIXED_POINT_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// The word to add for `value`, held to [least, most]; what is no number counts as 0. `steps`: of one unit; least and
// most times steps are within 2^30. u in [0, 1), its own for each number: the mean over u is the held value, to 2^-24
// of a step (u of 24 bits) and to the rounding of value * steps as a float. Where that is a bias it is `least` and
// `most` that cut the values of samples, not the sum's.
FB_FN uint fixed_point(float value, float steps, float least, float most, float u) {
  float x = (value > least ? min(value, most) : value <= least ? least : 0.0f) * steps;
  // The fraction is exact, where x + u would lose bits of u and so round up more often than down.
  float whole = floor(x);
  return uint(int(whole) + (u < x - whole ? 1 : 0));
}

// The sums of such words, in units, rounded to a float's 24 bits. With signs: right while it lies in [-2^31, 2^31)
// steps at the end, whatever it was between. Without: of numbers whose `least` is 0 or above, below 2^32.
FB_FN float signed_sum(uint sum, float steps) { return float(int(sum)) / steps; }
FB_FN float unsigned_sum(uint sum, float steps) { return float(sum) / steps; }

// How many numbers fit whatever they are, where `most` is the greatest of |least| and |most|, at least one step.
FB_FN uint signed_room(float most, float steps) { return 0x7fffffffu / uint(-floor(-most * steps)); }
FB_FN uint unsigned_room(float most, float steps) { return 0xffffffffu / uint(-floor(-most * steps)); }

FB_NAMESPACE_END
#endif
