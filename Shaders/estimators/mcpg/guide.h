// States of Markov chain path guiding (Alber 2025): what a state holds, the vMF lobe that it stands for as seen from a
// point, how a sample updates it, and how all of it is packed.
#ifndef FB_MCPG_GUIDE_H
#define FB_MCPG_GUIDE_H
#include "shared/hash_grid.h"
#include "shared/vmf.h"
FB_NAMESPACE_BEGIN

// Alber 2025, Table 1. Weighted sums are kept divided by their weight, so that nothing overflows; 24 bytes packed.
struct GuideState {
  vec3 target;     // weighted mean of where the light came from, world units
  float weight;    // mean score; 0: no state
  float spread;    // 1 - mean cosine of directions to the light (the complement keeps the digits of narrow lobes); or
                   // its extent, units squared: that times the distance squared
  uint count;      // samples, at most 255
  uint check;      // GridKey::check of the cell that it was stored for
  uint time;       // frame of the last sample that confirmed it, modulo 2^16
  vec3 velocity;   // of the target, units a second
  float emissive;  // share of the score that came from emission, the rest from reflection
};

FB_FN GuideState empty_guide_state() {
  GuideState s;
  s.target = vec3(0.0f);
  s.weight = 0.0f;
  s.spread = 0.0f;
  s.count = 0u;
  s.check = 0u;
  s.time = 0u;
  s.velocity = vec3(0.0f);
  s.emissive = 0.0f;
  return s;
}

// Packing: four words that every reader needs, two that only moving lights and updates do.
//   0, 1: target, 21 bits a coordinate in steps of 1/32 unit; 1 bit: it moves
//   2: check; weight as 1 + 682 (log2 + 40), 0: none
//   3: square root of spread, half precision; count, 8 bits; emissive, 8 bits
//   4, 5: velocity, three halves; time
FB_CONST float kTargetSteps = 32.0f;
FB_CONST float kTargetLimit = 32767.9375f;
FB_CONST float kWeightSteps = 682.0f;

FB_FN uint pack_guide_coordinate(float x) {
  return uint(int(floor((clamp(x, -kTargetLimit, kTargetLimit) + 32768.0f) * kTargetSteps + 0.5f)));
}
FB_FN float unpack_guide_coordinate(uint u) { return float(u) * (1.0f / kTargetSteps) - 32768.0f; }
FB_FN uint pack_guide_weight(float w) {
  if (!(w > 0.0f)) return 0u;
  return uint(clamp((log2(w) + 40.0f) * kWeightSteps + 1.5f, 1.0f, 65535.0f));
}
FB_FN float unpack_guide_weight(uint u) {
  return u == 0u ? 0.0f : exp2((float(u) - 1.0f) * (1.0f / kWeightSteps) - 40.0f);
}

FB_FN uvec4 pack_guide_state(GuideState s) {
  uint x = pack_guide_coordinate(s.target.x), y = pack_guide_coordinate(s.target.y),
       z = pack_guide_coordinate(s.target.z);
  bool moves = dot(s.velocity, s.velocity) > 0.0f;
  uint root = packHalf2x16(vec2(min(sqrt(s.spread), 60000.0f), 0.0f)) & 0xffffu;
  return uvec4(x | (y << 21u), (y >> 11u) | (z << 10u) | (moves ? 0x80000000u : 0u),
               (s.check & 0xffffu) | (pack_guide_weight(s.weight) << 16u),
               root | (min(s.count, 255u) << 16u) | (uint(clamp(s.emissive, 0.0f, 1.0f) * 255.0f + 0.5f) << 24u));
}
FB_FN uvec2 pack_guide_motion(GuideState s) {
  vec3 v = vec3(clamp(s.velocity.x, -60000.0f, 60000.0f), clamp(s.velocity.y, -60000.0f, 60000.0f),
                clamp(s.velocity.z, -60000.0f, 60000.0f));
  return uvec2(packHalf2x16(vec2(v.x, v.y)), (packHalf2x16(vec2(v.z, 0.0f)) & 0xffffu) | (s.time << 16u));
}
FB_FN bool guide_state_moves(uvec4 words) { return (words.y & 0x80000000u) != 0u; }
// Velocity and time are left zero.
FB_FN GuideState unpack_guide_state(uvec4 words) {
  GuideState s;
  s.target = vec3(unpack_guide_coordinate(words.x & 0x1fffffu),
                  unpack_guide_coordinate((words.x >> 21u) | ((words.y & 0x3ffu) << 11u)),
                  unpack_guide_coordinate((words.y >> 10u) & 0x1fffffu));
  s.check = words.z & 0xffffu;
  s.weight = unpack_guide_weight(words.z >> 16u);
  float root = unpackHalf2x16(words.w & 0xffffu).x;
  s.spread = root * root;
  s.count = (words.w >> 16u) & 0xffu;
  s.emissive = float(words.w >> 24u) / 255.0f;
  s.velocity = vec3(0.0f);
  s.time = 0u;
  return s;
}
FB_FN GuideState add_guide_motion(GuideState s, uvec2 words) {
  vec2 xy = unpackHalf2x16(words.x), z = unpackHalf2x16(words.y & 0xffffu);
  s.velocity = vec3(xy.x, xy.y, z.x);
  s.time = words.y >> 16u;
  return s;
}

FB_CONST float kPriorAngle = 0.005f;  // tangent of half the angle that a light is thought to fill at least

// How a state's light looks from a point.
struct GuideView {
  vec3 direction;  // to its mean, unit
  float distance2;
  float spread;  // 1 - mean cosine of its lobe
  float scale;   // score at the point over the state's weight
};

// `to_target` from the point, not zero; `cosine` between it and the surface's normal there; `radius2`: size squared
// that a light is thought to have before anything is known.
//
// `in_world`: extent and weight are kept as the light's own (units squared; score times distance squared over cosine),
// so that they hold from any point. Else they are those at the point that learnt them, and the prior is Alber 2025,
// Alg. 2 line 7 with N_p = radius2 / distance^2 and r_p = 0.
FB_FN GuideView view_guide_state(GuideState s, vec3 to_target, float cosine, float radius2, bool in_world) {
  GuideView v;
  v.distance2 = dot(to_target, to_target);
  v.direction = to_target * (1.0f / sqrt(v.distance2));
  float n = max(float(s.count), 1.0f), n2 = n * n;
  if (in_world) {
    float prior = max(radius2, kPriorAngle * kPriorAngle * v.distance2);
    float extent2 = (n2 * s.spread + prior) / (n2 + 1.0f);
    float reach2 = v.distance2 + extent2;
    v.spread = extent2 / reach2;
    v.scale = max(cosine, 0.1f) / reach2;
  } else {
    float prior = radius2 / v.distance2;
    v.spread = clamp((n2 * s.spread + prior) / (n2 + prior), 0.0f, 1.0f);
    v.scale = 1.0f;
  }
  return v;
}

// Folds a sample into a state (Alber 2025, Alg. 3 lines 4 to 9): `score` is the sample's (over GuideView::scale),
// `target` where it hit, seen from `position`. A score of zero only lowers the weight. Scores must be finite and not
// negative.
FB_FN GuideState update_guide_state(GuideState s, vec3 position, vec3 target, float score, float emissive,
                                    float alpha_min, float count_max, bool in_world) {
  vec3 before = s.target - position, now = target - position;
  s.count = uint(min(float(s.count) + 1.0f, min(count_max, 255.0f)));
  float alpha = max(1.0f / float(s.count), alpha_min);
  float kept = s.weight * (1.0f - alpha), added = score * alpha;
  s.weight = kept + added;
  if (!(added > 0.0f) || !(s.weight > 0.0f)) return s;
  float share = kept > 0.0f ? clamp(added / s.weight, 0.0f, 1.0f) : 1.0f;
  float b2 = dot(before, before), n2 = dot(now, now);
  float spread = s.spread;  // nothing to learn where a target is at the point itself
  if (!(kept > 0.0f)) {
    spread = 0.0f;
  } else if (b2 > 0.0f && n2 > 0.0f) {
    // 1 - cosine = |a - b|^2 / 2 of unit vectors, without cancellation
    vec3 d = before * (1.0f / sqrt(b2)) - now * (1.0f / sqrt(n2));
    float c = min(0.5f * dot(d, d), 1.0f);
    spread = in_world ? c / max(1.0f - c, 0.05f) * b2 : c;
  }
  s.spread = s.spread + (spread - s.spread) * share;
  s.target = s.target + (target - s.target) * share;
  s.emissive = s.emissive + (emissive - s.emissive) * share;
  return s;
}

// --- the irradiance cache and what is learnt beside it: words of an entry in kGuideCache ---
FB_CONST uint kCacheWords = 16u;
FB_CONST uint kCacheCheck = 0u;    // 0: empty
FB_CONST uint kCacheMean = 1u;     // three floats: mean of cos L / (pi pdf): what a white surface there reflects
FB_CONST uint kCacheCount = 4u;    // frames that updated it, at most 65535, and the last of them << 16
FB_CONST uint kCacheMoment = 5u;   // two words of two halves: relative second moments, one for each of guide_shares()
FB_CONST uint kCacheTouched = 7u;  // this frame: samples, and whether it is claimed
FB_CONST uint kCacheClaimed = 0x80000000u;
FB_CONST uint kCacheClaim = 8u;       // this frame: the largest check that wants the entry
FB_CONST uint kCacheSum = 9u;         // this frame, fixed point: three sums of radiance
FB_CONST uint kCacheMomentSum = 12u;  // this frame, fixed point: four sums of second moments
// The words after all entries and the list of touched ones. In turns, for this frame and the next: how many are listed;
// of how many cells sums were made; the sums of their moments and of their means' luminance. Then averages of these
// sums; zero: none yet.
FB_CONST uint kTailCells = 2u;
FB_CONST uint kTailMomentSums = 4u;
FB_CONST uint kTailMomentMeans = 12u;  // four floats
FB_CONST uint kTailLightSums = 16u;
FB_CONST uint kTailLightMean = 18u;  // a float
FB_CONST uint kTailWords = 20u;
FB_CONST float kTailLargest = 2147483648.0f;  // that all cells together may add to a sum
FB_CONST float kTailLightFixed = 4096.0f;     // steps a unit of luminance; moments are added in steps of one
FB_CONST float kCacheFixed = 16384.0f;        // steps a unit of radiance
FB_CONST float kCacheLargest = 64.0f;         // radiance that a sample may bring
FB_CONST float kMomentFixed = 8.0f;           // steps a unit of relative second moment
FB_CONST float kMomentLargest = 60000.0f;

// Probabilities of guiding whose second moments are compared (steps/propose.glsl).
FB_FN vec4 guide_shares() { return vec4(0.0f, 0.3f, 0.6f, 0.85f); }

// Moments of these shares, not negative, none above `largest`. All are cut or none: what guiding misses costs the more
// the more one guides, and a bound of each alone would hide it.
FB_FN vec4 bound_moments(vec4 m, float largest) {
  float most = max(max(m.x, m.y), max(m.z, m.w));
  return most > largest ? m * (largest / most) : m;
}

FB_CONST uint kPastFrames = 32u;    // whose times are known
FB_CONST uint kTrustedFrames = 8u;  // for which a light is thought to keep its velocity

FB_NAMESPACE_END
#endif
