// Before cells are folded: sums up, over parts of the world, straight light of this frame and as cells remember it.
// After, as a second variant (SWEEPS), where it changed: cells that no sample came to follow it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/pstf/steps/cells.glsl"

layout(constant_id = kSpecSweeps) const bool SWEEPS = false;

layout(local_size_x = 64) in;

void add_to_region(uint region, RegionLight r, uint bits) {
  uint at = pstf_region_at(pstf.frame_number, region);
  float most = kMostRegionSamples * kMostRegionLight, many = kMostRegionSamples * kMostRegionVariance * 2.0;
  atomicAdd(pstf_sums.at[at], fixed_point(r.now, kRegionSteps, 0.0, most, rng_uniform(bits)));
  atomicAdd(pstf_sums.at[at + 1u], fixed_point(r.memory, kRegionSteps, 0.0, most, rng_uniform(bits)));
  atomicAdd(pstf_sums.at[at + 2u], fixed_point(r.variance, kRegionVarianceSteps, 0.0, many, rng_uniform(bits)));
  atomicAdd(pstf_sums.at[at + 3u], fixed_point(r.scatter, 1.0, 0.0, most * most, rng_uniform(bits)));
  atomicAdd(pstf_sums.at[at + 4u], fixed_point(r.samples, kRegionSteps, 0.0, most, rng_uniform(bits)));
}

void add_cell(uint slot) {
  uint cell = slot * (kPstfCellWords / 4u);
  float samples = float(pstf_sums.at[pstf_samples_at(slot)] & ~kPstfClaimed);
  uvec4 straight = pstf_cells.at[cell + 6u];
  if (samples == 0.0 || straight.y == 0u || samples > float(signed_room(kPstfLargest, kPstfSteps))) return;
  float now = signed_sum(pstf_sums.at[pstf_sums_at(slot) + kPstfSumStraight], kPstfSteps) / samples;
  RegionLight r =
      light_of_cell(now, uintBitsToFloat(straight.x), uintBitsToFloat(pstf_cells.at[cell + 1u].x),
                    uintBitsToFloat(pstf_cells.at[cell + 5u].w), samples, uintBitsToFloat(pstf_cells.at[cell].w));
  if (r.samples == 0.0) return;
  uint bits = hash_combine(slot, pstf.frame_number);
  for (uint level = 0u; level < kRegionLevels; ++level) add_to_region(region_of(straight.y, level), r, bits);
}

void sweep(uint slot) {
  uint cell = slot * (kPstfCellWords / 4u);
  uvec4 head = pstf_cells.at[cell], straight = pstf_cells.at[cell + 6u];
  if (head.x == 0u || head.y == pstf.frame_number) return;
  float change = region_change(straight.y);
  if (change == 1.0) return;
  pstf_cells.at[cell].w = floatBitsToUint(min(uintBitsToFloat(head.w), kKeptFrames * uintBitsToFloat(head.z)));
  for (uint texel = 1u; texel <= 3u; ++texel)
    pstf_cells.at[cell + texel] = floatBitsToUint(uintBitsToFloat(pstf_cells.at[cell + texel]) * change);
  float second = uintBitsToFloat(pstf_cells.at[cell + 5u].w) * change * change;
  pstf_cells.at[cell + 5u].w = floatBitsToUint(second);
  pstf_cells.at[cell + 6u].x = floatBitsToUint(uintBitsToFloat(straight.x) * change);
}

void main() {
  uint first = gl_GlobalInvocationID.x, stride = gl_NumWorkGroups.x * 64u;
  if (SWEEPS) {
    if (pstf_sums.at[pstf_changed_at(pstf.frame_number)] == 0u) return;
    for (uint slot = first; slot < uint(pstf.pstf_cells); slot += stride) sweep(slot);
    return;
  }
  // The next frame's.
  if (first == 0u) pstf_sums.at[pstf_changed_at(pstf.frame_number + 1u)] = 0u;
  for (uint i = first; i < kAllRegions * kRegionWords; i += stride)
    pstf_sums.at[pstf_region_at(pstf.frame_number + 1u, 0u) + i] = 0u;
  if (pstf.pstf_change <= 0.0) return;
  uint touched = pstf_sums.at[pstf_count_at(pstf.frame_number)];
  for (uint i = first; i < touched; i += stride) add_cell(pstf_sums.at[pstf_list_at() + i]);
}
