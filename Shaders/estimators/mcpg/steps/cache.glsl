// The irradiance cache: what a white surface reflects, averaged over cells of an adaptive hash grid. For training (and,
// in a biased estimator, for the end of paths); an unbiased estimator's picture never holds it.
//
// Readers see the former frame's means; this frame's samples are added up in fixed point beside them, with atomic
// additions, whose order does not matter, and folded in by fold_cache.comp. So there are no locks, and the same
// samples give the same cache in any order.
#ifndef FB_MCPG_CACHE
#define FB_MCPG_CACHE
#include "estimators/mcpg/mcpg.h"
#include "lib/frame_bindings.glsl"
#include "shared/color.h"
#include "shared/scene_gpu.h"

layout(constant_id = kSpecGuides) const bool GUIDES = true;  // vertices take states from cells and teach them

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform GuideBlock { GuideConstants guide; };
FB_TECHNIQUE_ARRAY(kGuideStates, 16, , GuideStateArray, uvec4, guide_states)
FB_TECHNIQUE_ARRAY(kGuideProposals, 16, , GuideProposalArray, uvec4, guide_proposals)
FB_TECHNIQUE_ARRAY(kGuideCache, 4, , GuideCacheArray, uint, guide_cache)

// Motions lie after the states, two in a word of four.
void store_guide_motion(uint at, uvec2 motion) {
  uint word = guide.mc_states + (at >> 1u);
  if ((at & 1u) == 0u)
    guide_states.at[word].xy = motion;
  else
    guide_states.at[word].zw = motion;
}

const uint kCacheStale = 120u;  // frames after which another cell may take an entry

uint guide_list_at() { return guide.mc_cells * kCacheWords; }
uint guide_tail_at() { return guide.mc_cells * (kCacheWords + 1u); }
// Two counters take turns: while one counts, the other is set to zero for the next frame. So do the sums of all cells.
uint guide_list_count_at() { return guide_tail_at() + (guide.frame_number & 1u); }
uint guide_next_count_at() { return guide_tail_at() + ((guide.frame_number + 1u) & 1u); }
uint guide_summed_cells_at(uint number) { return guide_tail_at() + kTailCells + (number & 1u); }
uint guide_moment_sums_at(uint number) { return guide_tail_at() + kTailMomentSums + 4u * (number & 1u); }
uint guide_light_sum_at(uint number) { return guide_tail_at() + kTailLightSums + (number & 1u); }
uint guide_winner_at() { return guide_tail_at() + kTailWords; }

// Of the proposals for one slot, the one of highest rank is taken: as good as random, and the same in any order. Those
// that saw the light come first: they alone say where it is now. Multiplication by an odd number and exclusive or
// permute the words.
uint proposal_rank(uint proposal, bool seen) {
  uint rank = (((proposal + 1u) * 2654435769u) ^ hash_u32(guide.frame_number)) & 0x7fffffffu;
  return seen ? rank | 0x80000000u : rank;
}

struct CacheCell {
  uint entry;  // first word of the entry that holds the cell, or kNoIndex
  uint claim;  // first word of the entry that it could have, or kNoIndex
  uint check;  // for the claim
};

layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kGuideCache) uniform usamplerBuffer cache_texels;

// Four words of an entry, from a multiple of four on.
uvec4 cache_quad(uint word) { return texelFetch(cache_texels, int(word >> 2u)); }

uint cache_frames(uint entry) { return cache_quad(entry + kCacheCount).x & 0xffffu; }
uint cache_age(uint entry) { return (guide.frame_number - (cache_quad(entry + kCacheCount).x >> 16u)) & 0xffffu; }

uint cell_check(uint slot) { return cache_quad(slot * kCacheWords + kCacheCheck).x; }
uint cell_age(uint slot) { return cache_age(slot * kCacheWords); }
#include "lib/cells.glsl"

// The cell about a point, of surfaces (kCacheTag) or of the medium (kMediumTag).
CacheCell find_cache_cell(vec3 p, vec3 n, uint kind, inout uint group_rng) {
  CellPlace place = find_cell(p, n, kind, guide.cache_angle, guide.mc_cells, kCacheStale, group_rng);
  return CacheCell(place.slot == kNoIndex ? kNoIndex : place.slot * kCacheWords,
                   place.claim == kNoIndex ? kNoIndex : place.claim * kCacheWords, place.check);
}

vec3 cached_reflection(uint entry) { return uintBitsToFloat(cache_quad(entry + kCacheCheck).yzw); }

// Second moments of estimates there for each of guide_shares(), over the square of the mean; zero: unknown.
vec4 cached_moments(uint entry) {
  uvec4 words = cache_quad(entry + kCacheCount);
  return vec4(unpackHalf2x16(words.y), unpackHalf2x16(words.z));
}

// The same in the mean of all cells of the last frames.
vec4 mean_moments() { return uintBitsToFloat(cache_quad(guide_tail_at() + kTailMomentMeans)); }
float mean_luminance() {
  return uintBitsToFloat(cache_quad(guide_tail_at() + kTailLightSums)[kTailLightMean - kTailLightSums]);
}

// Lists an entry at its first touch; `before`: its word kCacheTouched.
void list_touched(uint entry, uint before) {
  if (before != 0u) return;
  uint at = atomicAdd(guide_cache.at[guide_list_count_at()], 1u);
  guide_cache.at[guide_list_at() + at] = entry;
}

void claim_cache(CacheCell cell) {
  if (cell.claim == kNoIndex) return;
  atomicMax(guide_cache.at[cell.claim + kCacheClaim], cell.check);
  list_touched(cell.claim, atomicOr(guide_cache.at[cell.claim + kCacheTouched], kCacheClaimed));
}

// Rounded up or down at random, so that sums are right in the mean.
uint to_fixed(float value, float steps, float largest, float u) { return uint(clamp(value, 0.0, largest) * steps + u); }
#endif
