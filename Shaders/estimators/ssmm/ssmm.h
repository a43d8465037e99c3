// Screen-space Markov chain mixtures (Dittebrandt 2023): what its techniques keep, what can be set, what they show, and
// the algorithms that work on a state, for C++ too. Equations and algorithms are numbered as in the paper.
#ifndef FB_SSMM_H
#define FB_SSMM_H
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/settings.h"
#include "shared/vmf.h"
FB_NAMESPACE_BEGIN

// Arrays: X(constant, binding, what there is one element of, bytes of one, two halves, name).
//
// States: uvec4[2] of a pixel at which light is sampled (pack_chain_state): what its chain ended the last frame with.
// Lobes: the states that this frame samples from, of the same form: after exchange (passes/exchange.comp).
// World: uvec4[2] of a cell of the world, a state of the same form whose last word is GridKey::check: what chains of
// pixels in it ended with (r_ssmm_world). Claims: uint of a cell, whose pixel teaches it in this frame: claim_of().
// Claimed: the workgroups of passes/keep.comp, as VkDispatchIndirectCommand has them, and the number of cells that this
// frame's pixels claim: kSsmmClaimedWords; then those cells' places in the table, in any order.
#define FB_SSMM_ARRAYS(X)                                              \
  X(kSsmmStates, 0u, kPixel, 32u, false, "states of the chains")       \
  X(kSsmmLobes, 1u, kPixel, 32u, false, "states to sample from")       \
  X(kSsmmWorld, 2u, kTable, 32u, false, "states kept in the world")    \
  X(kSsmmClaims, 3u, kTable, 4u, false, "claims of the world's cells") \
  X(kSsmmClaimed, 4u, kTable, 4u, false, "cells that are claimed")
FB_SSMM_ARRAYS(FB_ARRAY_CONSTANT)

FB_CONST uint kSsmmCells = 65536u;  // of the world; a power of two
FB_CONST uint kSsmmClaimedWords = 4u;
FB_CONST uint kSsmmKeepGroup = 64u;  // cells of a workgroup of passes/keep.comp

// clang-format off
#define FB_SSMM_SETTINGS(X) \
  X(int, ssmm_tile, "r_ssmm_tile", 8, 8, 32, "ssmm: pixels of a tile, whose lobes are a mixture together: 8, 16 or 32, the nearest") \
  X(int, ssmm_temporal, "r_ssmm_temporal", 0, 0, 1, "ssmm: which lobes a sample's density is of: 0 all of the tile (Eq. 9); 1 as many as a pixel has samples a frame, one for each (Eq. 8)") \
  X(int, ssmm_shuffle, "r_ssmm_shuffle", 1, 0, 1, "ssmm: 1 the tile's pixels exchange lobes at random; 0 each keeps its own, biased") \
  X(int, ssmm_neighbors, "r_ssmm_neighbors", 5, 0, 32, "ssmm: pixels of the former frame from which a pixel may take a state") \
  X(float, ssmm_window, "r_ssmm_window", 91, 1, 1000, "ssmm: width of the window they are of, pixels of a picture of 1080 rows") \
  X(float, ssmm_defence, "r_ssmm_defence", 0.2f, 0.01f, 1, "ssmm: share of samples by the vertex's own scattering") \
  X(float, ssmm_prior, "r_ssmm_prior", 0.2f, 0, 1000, "ssmm: samples that the prior of a lobe's width counts as") \
  X(float, ssmm_prior_cosine, "r_ssmm_prior_cosine", 0, -1, 1, "ssmm: mean cosine of the prior; below 0: that of a ball of r_ssmm_prior_size at the target's distance") \
  X(float, ssmm_prior_size, "r_ssmm_prior_size", 8, 0.01f, 1000, "ssmm: radius of that ball, units") \
  X(float, ssmm_alpha, "r_ssmm_alpha", 0.1f, 0.001f, 1, "ssmm: least weight of a new sample in what a lobe is fitted to; one over r_ssmm_count where that is more") \
  X(int, ssmm_keep, "r_ssmm_keep", 2, 0, 2, "ssmm: 1 a state whose lobe found nothing in a frame stays, and counts for less: lobes become narrow; 0 it is gone; 2 it stays in ssmm and is gone in ssmm_nee") \
  X(int, ssmm_count, "r_ssmm_count", 8, 1, 65536, "ssmm: most samples that a lobe counts: the fewer, the wider the narrowest lobe; 1024 in the paper") \
  X(int, ssmm_apparent, "r_ssmm_apparent", 1, 0, 1, "ssmm: 1 light by way of an interface has its target where it appears to be (Ruppert 2020, Eq. 35); 0 on the interface") \
  X(int, ssmm_indirect, "r_ssmm_indirect", 0, 0, 1, "ssmm: 1 scores count light of more reflections, too; 0 what is emitted where the ray ends") \
  X(int, ssmm_product, "r_ssmm_product", 1, 0, 1, "ssmm: 1 scores count what the surface reflects of that; 0 its light over the density alone") \
  X(int, ssmm_world, "r_ssmm_world", 0, 0, 1, "ssmm: 1 states are kept in cells of the world, too, and pixels take them as those of neighbours; 0 on the screen alone (the paper)") \
  X(float, ssmm_cell, "r_ssmm_cell", 32, 1, 4096, "ssmm: width of those cells, units")
// clang-format on

FB_CONST uint kViewOfSsmm = kViewOfTechniques + 2u;
// clang-format off
#define FB_SSMM_VIEWS(X) \
  X(kViewSsmmLobe, 37u, kViewOfSsmm, "ssmm_lobe", "ssmm: where a pixel's lobe points, as a colour, brighter the narrower; black: it has none") \
  X(kViewSsmmCount, 38u, kViewOfSsmm, "ssmm_count", "ssmm: samples that a pixel's lobe was fitted to, by their logarithm; black: it has none")
// clang-format on
FB_SSMM_VIEWS(FB_VIEW_CONSTANT)

struct SsmmConstants {
  FB_SSMM_SETTINGS(FB_UNIFORM_FIELD)
  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)
  uint seen_stride;  // of this many shadow rays one is remembered; a power of two
  uint seen_ways;    // the table of ways that is read, 0 or 1
  uint known;        // 1: there are states of a former frame
};

// --- A chain's state (Table 1) ---
struct ChainState {
  vec3 target;   // weighted mean of where light was met, world units
  float spread;  // 1 - mean cosine of the directions there
  float weight;  // mean of scores; 0: the state is not valid
  float count;   // samples
  float score;   // of the sample by which it was accepted
};

FB_FN ChainState no_chain_state() {
  ChainState s;
  s.target = vec3(0.0f);
  s.spread = s.weight = s.count = s.score = 0.0f;
  return s;
}
FB_FN bool is_valid_state(ChainState s) { return s.weight > 0.0f; }
// What exchange weighs states by.
FB_FN float chain_score(ChainState s) { return is_valid_state(s) ? max(s.score, 0.0f) : 0.0f; }

// A score that is a number: what no float can hold, and what is not above zero, is no light.
FB_FN float usable_score(float f) { return f > 0.0f && f < 1e30f ? f : 0.0f; }

// The maximum likelihood update by a sample at `hit`, of score `f`, seen from `origin` (Alg. 3, lines 11 to 17).
// `alpha`: least weight of a sample; `most`: of the count. Not valid if nothing is left of its weight.
FB_FN ChainState updated_state(ChainState s, vec3 origin, vec3 hit, float f, float alpha, float most) {
  ChainState n = s;
  n.count = min(s.count + 1.0f, most);
  float a = max(1.0f / n.count, alpha);
  n.weight = s.weight + (f - s.weight) * a;
  if (!(n.weight > 0.0f)) return no_chain_state();
  float by = f * a / n.weight, kept = 1.0f - by;
  vec3 mean = s.target - origin, way = hit - origin;
  // |kept r mean + by way|, less from 1 without what would cancel.
  float t =
      s.weight > 0.0f ? vmf_one_minus_cosine(mean / max(length(mean), 1e-20f), way / max(length(way), 1e-20f)) : 0.0f;
  float square = kept * s.spread * (2.0f - kept * s.spread) + 2.0f * (1.0f - s.spread) * kept * by * t;
  n.spread = clamp(square / (1.0f + sqrt(max(1.0f - square, 0.0f))), 0.0f, 1.0f);
  n.target = s.weight > 0.0f ? s.target + (hit - s.target) * by : hit;
  return n;
}

// 1 - mean cosine of the prior: of directions evenly to a ball of that radius, so far away, or the cosine that is set.
FB_FN float prior_spread(float cosine, float radius, float distance) {
  if (cosine >= 0.0f) return 1.0f - cosine;
  float tangent = radius / max(distance, 1e-6f), root = sqrt(1.0f + tangent * tangent);
  return 0.5f * tangent * tangent / (root * (root + 1.0f));  // (1 - cos) / 2
}

// The lobe of a valid state as seen from `origin` (Alg. 2, lines 5 to 8): the prior counts as `prior` samples, against
// the square of the state's.
FB_FN VmfLobe chain_lobe(ChainState s, vec3 origin, float prior, float cosine, float radius) {
  vec3 way = s.target - origin;
  float distance = length(way), samples = s.count * s.count;
  float spread = (samples * s.spread + prior * prior_spread(cosine, radius, distance)) / (samples + prior);
  return vmf_lobe(way / max(distance, 1e-20f), vmf_kappa(spread));
}

// Whether a state has a lobe there: valid, and its target is not at that place.
FB_FN bool has_lobe(ChainState s, vec3 origin) {
  vec3 way = s.target - origin;
  return is_valid_state(s) && dot(way, way) > 1e-6f;
}

// Offset of a neighbour along an axis, in windows: a B-spline of degree 5, the sum of six random numbers, less its
// mean. The numbers are five bits each of `bits`: steps of 1/192 of a window.
FB_FN float spline_offset(uint bits) {
  uint sum = (bits & 31u) + ((bits >> 5u) & 31u) + ((bits >> 10u) & 31u) + ((bits >> 15u) & 31u) +
             ((bits >> 20u) & 31u) + ((bits >> 25u) & 31u);
  return (float(sum) - 93.0f) / 192.0f;
}

// --- Cells of the world ---
// A claim is larger than 0. Of claims of one cell the largest has it: of one pixel, at random in each frame, since
// claims are pixels' numbers in another order, by a number of the frame. One pixel in 2^32 would have claim 0: it
// claims nothing.
FB_FN uint claim_of(uint element, uint order) {
  uint x = (element ^ order) * 0x9e3779b1u;
  x = (x ^ (x >> 16u)) * 0x85ebca77u;
  return x ^ (x >> 16u);
}
FB_FN uint claiming_element(uint claim, uint order) {  // by both factors' inverses
  uint x = (claim ^ (claim >> 16u)) * 0xb6c92f47u;
  return ((x ^ (x >> 16u)) * 0xe8b2f51u) ^ order;
}

// What a cell keeps of its own and of what a pixel's chain ended with: either in proportion to their scores, by a
// random number `u`. Where the chain found nothing the cell's counts half: in the dark it fades.
FB_FN ChainState kept_in_world(ChainState cell, ChainState found, float u) {
  ChainState s = cell;
  if (!is_valid_state(found))
    s.score = 0.5f * cell.score;
  else if (!is_valid_state(cell) || u * cell.score < found.score)
    s = found;
  if (s.score < 1e-20f) s = no_chain_state();
  return s;
}

// --- Tiles ---
// 8 pixels are 4x2, 16 are 4x4, 32 are 8x4.
FB_FN uvec2 tile_size(uint lanes) { return lanes == 8u ? uvec2(4u, 2u) : lanes == 16u ? uvec2(4u, 4u) : uvec2(8u, 4u); }
FB_FN uint lanes_of(int setting) { return setting < 12 ? 8u : setting < 24 ? 16u : 32u; }
FB_FN uvec2 tile_of(uvec2 block, uint lanes) { return block / tile_size(lanes); }
FB_FN uint lane_of(uvec2 block, uint lanes) {
  uvec2 size = tile_size(lanes);
  return block.y % size.y * size.x + block.x % size.x;
}
FB_FN uvec2 block_of_lane(uvec2 tile, uint lane, uint lanes) {
  uvec2 size = tile_size(lanes);
  return tile * size + uvec2(lane % size.x, lane / size.x);
}
// Whose lobe a lane samples: by exclusive or with a random mask, which is even over all lanes, 0 too; or the lane so
// many further on.
FB_FN uint spatial_lane(uint lane, uint mask) { return lane ^ mask; }
FB_FN uint temporal_lane(uint lane, uint shift, uint lanes) { return (lane + shift) % lanes; }
FB_FN uint sampled_lane(uint lane, uint draw, uint path, uint lanes, bool temporal) {
  return temporal ? temporal_lane(lane, draw + path, lanes) : spatial_lane(lane, draw);
}
// Of whose lobes a sample's density is the mean: that of all paths of the pixel (Eq. 8), or of all lanes (Eq. 9).
FB_FN uint weighed_lanes(uint paths, uint lanes, bool temporal) { return temporal ? paths : lanes; }
FB_FN uint weighed_lane(uint lane, uint draw, uint i, uint lanes, bool temporal) {
  return temporal ? temporal_lane(lane, draw + i, lanes) : i;
}

FB_NAMESPACE_END
#endif
