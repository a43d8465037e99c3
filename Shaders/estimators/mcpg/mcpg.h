// Markov chain path guiding (Alber 2025), the techniques of this folder: what they keep, what can be set, what they
// show.
#ifndef FB_MCPG_H
#define FB_MCPG_H
#include "estimators/mcpg/guide.h"
#include "shared/bindings.h"
#include "shared/debug_views.h"
#include "shared/settings.h"
FB_NAMESPACE_BEGIN

// Arrays: X(constant, binding, what there is one element of, bytes of one, two halves, name).
//
// States: uvec4[], a state is one and a half of them; its motion lies behind all states. Cache: uint[], the entries of
// the irradiance cache, the list of touched ones, kTailWords, and the winning proposal of every state. Proposals:
// uvec4[2] of a vertex, what a frame's paths want to store, where it is resolved after them.
#define FB_MCPG_ARRAYS(X)                                                   \
  X(kGuideStates, 0u, kTable, 24u, false, "guide states")                   \
  X(kGuideCache, 1u, kTable, 4u * (kCacheWords + 1u), false, "guide cache") \
  X(kGuideProposals, 2u, kTable, 32u, false, "guide proposals")
FB_MCPG_ARRAYS(FB_ARRAY_CONSTANT)

// Specialisation constants.
FB_CONST uint kSpecResolve = kSpecTechnique;        // store proposals, which a pass resolves in a fixed order
FB_CONST uint kSpecAccesses = kSpecTechnique + 1u;  // cells that a vertex takes states from
FB_CONST uint kSpecBucket = kSpecTechnique + 2u;    // states in a cell
FB_CONST uint kSpecGuides = kSpecTechnique + 3u;    // vertices take states from cells and teach them

// clang-format off
#define FB_MCPG_SETTINGS(X) \
  X(int, mc_fog, "r_mc_fog", 0, 0, 1, "guide paths that begin in fog also where lights are looked for (mcpg_nee): fewer than a seventh less variance for twice the time; mcpg always does") \
  X(int, mc_paper, "r_mc_paper", 0, 0, 16, "path guiding: 1 the paper's own method and settings (Alber 2025), whatever the others say: cells of one state, five of them (more than 1: so many), both grids, a fixed probability of guiding") \
  X(int, mc_states, "r_mc_states", 1000000, 1024, 16777216, "path guiding: states in the hash table, 24 bytes each; rounded up to a power of two") \
  X(int, mc_cells, "r_mc_cells", 131072, 1024, 4194304, "path guiding: cells of the irradiance cache, 68 bytes each; rounded up to a power of two") \
  X(int, mc_accesses, "r_mc_accesses", 2, 1, 16, "path guiding: cells from which a vertex gathers states; times r_mc_bucket this is the paper's N_mc") \
  X(int, mc_bucket, "r_mc_bucket", 8, 1, 16, "path guiding: states in a cell, a power of two; 1 is the paper's table") \
  X(float, mc_adaptive, "r_mc_adaptive", 0, 0, 1, "path guiding: probability of gathering from the adaptive grid; the rest is from the static grid") \
  X(float, mc_angle, "r_mc_angle", 0.6f, 0.01f, 45, "path guiding: angle that an adaptive cell subtends at the camera, degrees") \
  X(float, mc_pixels, "r_mc_pixels", 4, 0, 256, "path guiding: least width of an adaptive cell, pixels") \
  X(float, mc_static_width, "r_mc_static", 64, 1, 4096, "path guiding: width of the first static cell that a vertex gathers from, units") \
  X(float, mc_wider, "r_mc_wider", 4, 1, 64, "path guiding: width of each further static cell over that of the one before") \
  X(float, mc_coarser, "r_mc_coarser", 0.3f, 0, 0.95f, "path guiding: probability of gathering one adaptive level coarser, applied again at each level") \
  X(float, mc_jitter, "r_mc_jitter", 0.4f, 0, 1, "path guiding: how far from its own cell a vertex may gather, at random, in halves of a cell's width: 1 as in the paper, where no border between cells shows; less, and cells know better what is seen where") \
  X(int, mc_parts, "r_mc_parts", 0, 0, 4, "path guiding: number of parts that a frame's paths are traced in, one after the other, so that each uses what those before it learnt; the last part has half of the paths. 0: 4 with r_deterministic, 2 on a GPU, 1 on a processor, which runs few paths at once anyway") \
  X(float, mc_share, "r_mc_share", 0.5f, 0, 1, "path guiding: probability of guiding (1 - p_bsdf), where it is not learnt") \
  X(int, mc_learn_share, "r_mc_learn_share", 1, 0, 1, "path guiding: learn the probability of guiding, from second moments of the estimate") \
  X(float, mc_share_min, "r_mc_share_min", 0, 0, 1, "path guiding: lower bound of the learnt probability of guiding") \
  X(float, mc_share_max, "r_mc_share_max", 0.5f, 0, 1, "path guiding: upper bound of the learnt probability of guiding") \
  X(float, mc_alpha, "r_mc_alpha", 0.03f, 0.0001f, 1, "path guiding: least weight of a new sample in a state's moving averages (alpha_min)") \
  X(int, mc_count, "r_mc_count", 255, 1, 255, "path guiding: upper bound of a state's sample count (N_max)") \
  X(float, mc_radius, "r_mc_radius", 32, 0.01f, 1024, "path guiding: radius of a light before samples show it (the prior of a lobe's width), units") \
  X(float, mc_power, "r_mc_power", 1, 0, 4, "path guiding: exponent of states' scores in the mixture's weights") \
  X(int, mc_share_score, "r_mc_score", 1, 0, 1, "path guiding: 1 a state's score is its lobe's share of the light; 0 the whole estimate, as in the paper") \
  X(int, mc_in_world, "r_mc_world", 1, 0, 1, "path guiding: 1 states keep the light's own extent and strength; 0 as seen from the point that learnt them, as in the paper") \
  X(int, mc_cache, "r_mc_cache", 1, 0, 1, "path guiding: learn from reflected light too, which the irradiance cache estimates") \
  X(float, mc_cache_alpha, "r_mc_cache_alpha", 0.15f, 0.001f, 1, "path guiding: least weight of a new frame in the irradiance cache; larger adapts faster, smaller is smoother") \
  X(float, mc_cache_pixels, "r_mc_cache_pixels", 8, 0, 256, "path guiding: least width of a cell of the irradiance cache, pixels") \
  X(int, mc_train, "r_mc_train", 2, 1, 64, "path guiding: where the irradiance cache is well sampled, one in this many paths trains the states; light that no lobe explains is always learnt") \
  X(int, mc_tail_train, "r_mc_tail_train", 8, 1, 64, "path guiding: with mcpg_tail and mcpg_nee_tail, one in this many paths is traced one reflection further, to train the irradiance cache out of the camera's sight") \
  X(int, mc_loss, "r_mc_loss", 1, 0, 1, "path guiding: discard states whose light is gone") \
  X(int, mc_predict, "r_mc_predict", 1, 0, 1, "path guiding: extrapolate targets by the velocity of their light") \
  X(int, mc_apparent, "r_mc_apparent", 1, 0, 1, "path guiding: 1 the target of light that an interface of water bent is where it appears to be (Ruppert 2020), 0 where it is") \
  X(int, mc_previous, "r_mc_previous", 1, 0, 1, "path guiding: on moving surfaces, gather also where the point was in the previous frame")

// Debug views.
FB_CONST uint kViewOfMcpg = kViewOfTechniques;
#define FB_MCPG_VIEWS(X) \
  X(kViewGuideDirection, 20u, kViewOfMcpg, "guide_direction", "path guiding: direction of the strongest lobe") \
  X(kViewGuideCosine, 21u, kViewOfMcpg, "guide_cosine", "path guiding: its mean cosine") \
  X(kViewGuideWeight, 22u, kViewOfMcpg, "guide_weight", "path guiding: its score") \
  X(kViewGuideSamples, 23u, kViewOfMcpg, "guide_samples", "path guiding: samples that it counts") \
  X(kViewGuideLevel, 24u, kViewOfMcpg, "guide_level", "path guiding: level of the adaptive grid, and its cells") \
  X(kViewGuideCollisions, 25u, kViewOfMcpg, "guide_collisions", "path guiding: hash collisions") \
  X(kViewGuideAge, 26u, kViewOfMcpg, "guide_age", "path guiding: frames since the last sample") \
  X(kViewGuideCache, 27u, kViewOfMcpg, "guide_cache", "path guiding: the irradiance cache") \
  X(kViewGuideSampler, 28u, kViewOfMcpg, "guide_sampler", "path guiding: what was sampled: a lobe, or the BSDF") \
  X(kViewGuideShare, 29u, kViewOfMcpg, "guide_share", "path guiding: probability of guiding") \
  X(kViewGuideIncident, 31u, kViewOfMcpg, "guide_incident", "path guiding: light by direction at the picture's middle, and the density it is sampled with") \
  X(kViewGuideCover, 32u, kViewOfMcpg, "guide_cover", "path guiding: the sampler's view; linear pictures hold second moments (testdemos/coverage.py)")
// clang-format on
FB_MCPG_VIEWS(FB_VIEW_CONSTANT)

// The technique's uniform block. Settings as they hold in this frame: sizes are powers of two, probabilities of guiding
// leave room for the BSDF, and the shares that train grow with the samples of a pixel.
struct GuideConstants {
  vec4 elapsed[kPastFrames / 4u];  // seconds since the frame that is so many frames old
  FB_MCPG_SETTINGS(FB_UNIFORM_FIELD)
  FB_LIGHT_SETTINGS(FB_UNIFORM_FIELD)
  float adaptive_angle;  // tangent of the angle that an adaptive cell subtends
  float cache_angle;     // the same of a cell of the irradiance cache
  float prior_extent;    // radius of the prior, squared
  uint frame_number;     // frames since the guide forgot, from 1
  uint seen_stride;      // of this many shadow rays one is remembered; a power of two
  uint seen_ways;        // the table of ways that is read, 0 or 1
  uint vertices;         // of this frame's paths: as many proposals
};

FB_NAMESPACE_END
#endif
