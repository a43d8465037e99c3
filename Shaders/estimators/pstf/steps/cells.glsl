// The block and the arrays of progressive spatio-temporal filtering, and its cells.
//
// Readers see the former frames' fields; this frame's samples are added up in fixed point, in any order, and blended in
// by passes/fold.comp. So there are no locks, and the same samples give the same fields.
#ifndef FB_PSTF_CELLS
#define FB_PSTF_CELLS
#include "estimators/pstf/pstf.h"
#include "lib/frame_bindings.glsl"
#include "shared/fixed_point.h"
#include "shared/rng.h"
#include "shared/scene_gpu.h"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform PstfBlock {
  layout(offset = kPstfConstantsAt) PstfConstants pstf;
};
FB_TECHNIQUE_ARRAY(kPstfCells, 16, , PstfCellArray, uvec4, pstf_cells)
FB_TECHNIQUE_ARRAY(kPstfSums, 4, , PstfSumArray, uint, pstf_sums)
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsTechnique + kPstfCells) uniform usamplerBuffer pstf_texels;

const uint kPstfStale = 120u;  // frames after which another cell may take a slot

uint pstf_samples_at(uint slot) { return slot; }
uint pstf_claim_at(uint slot) { return uint(pstf.pstf_cells) + slot; }
uint pstf_sums_at(uint slot) { return 2u * uint(pstf.pstf_cells) + slot * kPstfSumWords; }
uint pstf_list_at() { return (2u + kPstfSumWords) * uint(pstf.pstf_cells); }
// While one counts, the other is set to zero for the next frame.
uint pstf_count_at(uint frame_number) { return (3u + kPstfSumWords) * uint(pstf.pstf_cells) + (frame_number & 1u); }

uint pstf_changed_at(uint frame_number) { return pstf_count_at(0u) + 2u + (frame_number & 1u); }
uint pstf_region_at(uint frame_number, uint region) {
  return pstf_count_at(0u) + 4u + ((frame_number & 1u) * kAllRegions + region) * kRegionWords;
}

// The part of the world about a point.
uint region_about(vec3 p) {
  ivec3 fine = ivec3(floor(p / kRegionWidth)), wide = ivec3(floor(p / (kWideRegion * kRegionWidth)));
  return region_word(hash_combine(hash_combine(uint(fine.x), uint(fine.y)), uint(fine.z)),
                     hash_combine(hash_combine(uint(wide.x), uint(wide.y)), uint(wide.z)));
}
RegionLight region_light(uint region) {
  uint at = pstf_region_at(pstf.frame_number, region);
  return RegionLight(unsigned_sum(pstf_sums.at[at], kRegionSteps), unsigned_sum(pstf_sums.at[at + 1u], kRegionSteps),
                     unsigned_sum(pstf_sums.at[at + 2u], kRegionVarianceSteps),
                     unsigned_sum(pstf_sums.at[at + 3u], 1.0), unsigned_sum(pstf_sums.at[at + 4u], kRegionSteps));
}
// Of straight light about a cell in this frame, behind the pass that sums parts of the world; 1: none is known.
float region_change(uint word) {
  float change = 1.0;
  if (word == 0u || pstf.pstf_change <= 0.0) return change;
  bool known = false;
  for (uint level = 0u; level < kRegionLevels && !known; ++level) {
    RegionLight r = region_light(region_of(word, level));
    change = change_of_light(r, pstf.pstf_change);
    known = change != 1.0 || knows_change(r, pstf.pstf_change);
  }
  return change;
}

uvec4 pstf_texel(uint slot, uint i) { return texelFetch(pstf_texels, int(slot * (kPstfCellWords / 4u) + i)); }

uint pstf_cell_check(uint slot) { return pstf_texel(slot, 0u).x; }
uint pstf_cell_age(uint slot) { return pstf.frame_number - pstf_texel(slot, 0u).y; }
#define FIND_CELL find_pstf_cell
#define CELL_CHECK pstf_cell_check
#define CELL_AGE pstf_cell_age
#include "lib/cells.glsl"

// Outgoing light over reflectance, for a surface of this normal.
vec3 outgoing_light(uint slot, vec3 normal) {
  vec4 light = uintBitsToFloat(pstf_texel(slot, 1u));
  vec3 mean = vec3(light.x, uintBitsToFloat(pstf_texel(slot, 2u).xy));
  if (pstf.pstf_normals != 0) {
    vec3 mean_normal = uintBitsToFloat(pstf_texel(slot, 4u).xyz);
    float here = light_of_normal(mean.x, light.yzw, mean_normal, normal);
    mean *= mean.x > 0.0 ? here / mean.x : 0.0;
  }
  return max(rgb_from_ycocg(mean), vec3(0.0));
}

// Lists a cell at its first touch; `before`: its word of samples.
void list_cell(uint slot, uint before) {
  if (before == 0u) pstf_sums.at[pstf_list_at() + atomicAdd(pstf_sums.at[pstf_count_at(pstf.frame_number)], 1u)] = slot;
}
#endif
