// Blends this frame's samples into the cells that have any (Eq. 10 and 11), and gives claimed cells away.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/pstf/pstf_tree.h"
#include "estimators/pstf/steps/cells.glsl"

layout(constant_id = kSpecTrees) const bool TREES = false;
FB_TECHNIQUE_ARRAY(kPstfTrees, 4, , PstfTreeArray, uint, pstf_trees)
FB_TECHNIQUE_ARRAY(kPstfTreeSums, 4, , PstfTreeSumArray, uint, pstf_tree_sums)

layout(local_size_x = 64) in;

vec4 light_sum(uint word, float scale) {
  vec4 sum;
  for (uint i = 0u; i < 4u; ++i) sum[i] = signed_sum(pstf_sums.at[word + i], kPstfSteps) * scale;
  return sum;
}
vec2 color_sum(uint word, float scale) {
  return vec2(signed_sum(pstf_sums.at[word + 4u], kPstfSteps), signed_sum(pstf_sums.at[word + 5u], kPstfSteps)) * scale;
}
float moment_sum(uint word, float scale) { return signed_sum(pstf_sums.at[word], kPstfMomentSteps) * scale; }

void store_tree(uint slot, DirectionTree t) {
  for (uint i = 0u; i < kTreeLeaves; ++i) {
    pstf_trees.at[slot * 2u * kTreeLeaves + i] = t.leaf[i];
    pstf_trees.at[slot * 2u * kTreeLeaves + kTreeLeaves + i] = floatBitsToUint(t.light[i]);
  }
}

const uint kTreeSteps = 2u;       // of splitting and collapsing, a frame
const float kFirstPixels = 16.0;  // whose samples a new cell's crowd is thought to be

void fold_tree(uint slot, float each, float blend) {
  DirectionTree t;
  for (uint i = 0u; i < kTreeLeaves; ++i) {
    uint sum = slot * kTreeLeaves + i;
    t.leaf[i] = pstf_trees.at[slot * 2u * kTreeLeaves + i];
    float before = uintBitsToFloat(pstf_trees.at[slot * 2u * kTreeLeaves + kTreeLeaves + i]);
    t.light[i] = mix(before, unsigned_sum(pstf_tree_sums.at[sum], kPstfSteps) * each, blend);
    pstf_tree_sums.at[sum] = 0u;
  }
  uint step = 0u;
  do split_and_collapse(t, pstf.pstf_split);
  while (++step < kTreeSteps);
  set_probabilities(t);
  store_tree(slot, t);
}

void fold_cell(uint slot, float samples) {
  uint cell = slot * (kPstfCellWords / 4u), sums = pstf_sums_at(slot);
  float directed = float(pstf_sums.at[sums + kPstfSumDirected]);
  float each = 1.0 / samples, each_directed = directed > 0.0 ? 1.0 / directed : 0.0;

  uvec4 head = pstf_cells.at[cell];
  // A sample's share was taken in so many: the crowd is all of them.
  float share = min(float(pstf.pstf_samples) / max(uintBitsToFloat(head.z), 1.0), 1.0);
  // More than sums have room for only say how many there are.
  if (samples > float(signed_room(kPstfLargest, kPstfSteps))) {
    pstf_cells.at[cell] = uvec4(head.x, pstf.frame_number, floatBitsToUint(samples / share), head.w);
    if (TREES)
      for (uint i = 0u; i < kTreeLeaves; ++i) pstf_tree_sums.at[slot * kTreeLeaves + i] = 0u;
    return;
  }
  vec4 outgoing = uintBitsToFloat(pstf_cells.at[cell + 1u]), colors = uintBitsToFloat(pstf_cells.at[cell + 2u]);
  vec4 incident = uintBitsToFloat(pstf_cells.at[cell + 3u]), normal = uintBitsToFloat(pstf_cells.at[cell + 4u]);
  vec4 moments = uintBitsToFloat(pstf_cells.at[cell + 5u]);
  vec4 outgoing_now = light_sum(sums, each);
  float second_now = moment_sum(sums + kPstfSumSecond, each);

  float straight_now = signed_sum(pstf_sums.at[sums + kPstfSumStraight], kPstfSteps) * each;
  uvec4 part = pstf_cells.at[cell + 6u];  // straight light, and the part of the world
  float straight = uintBitsToFloat(part.x), change = region_change(part.y);
  bool follows = change != 1.0;

  float before = uintBitsToFloat(head.w);
  if (!follows && has_changed(outgoing_now.x, outgoing.x, moments.w, samples, pstf.pstf_change)) before = 0.0;
  float blend = pstf_blend(samples, before, pstf.pstf_window), directed_blend = directed > 0.0 ? blend : 0.0;
  float straight_mean = mix(straight, straight_now, blend), scale = 1.0, scale_now = 1.0, scale_before = 1.0;
  if (follows) {
    atomicOr(pstf_sums.at[pstf_changed_at(pstf.frame_number)], 1u);
    float passed_on = mix(outgoing.x - straight, outgoing_now.x - straight_now, blend);  // from cell to cell
    straight_mean = mix(change * straight, straight_now, samples / (samples + kFollowedSamples));
    float all = mix(outgoing.x, outgoing_now.x, blend);
    scale = all > 0.0 ? (straight_mean + change * max(passed_on, 0.0)) / all : 0.0;
    scale_now = outgoing_now.x > 0.0 ? change + (1.0 - change) * straight_now / outgoing_now.x : 1.0;
    scale_before = change;
    before = min(before, kKeptFrames * samples);
  }
  if (TREES) fold_tree(slot, each_directed, directed_blend);
  vec3 normal_now;
  for (uint i = 0u; i < 3u; ++i) normal_now[i] = signed_sum(pstf_sums.at[sums + kPstfSumNormal + i], kPstfSteps) * each;
  ControlMoments control = joined_moments(
      ControlMoments(moments.x, moments.y, moments.z, normal.w),
      ControlMoments(moment_sum(sums + kPstfSumMoments, each_directed),
                     moment_sum(sums + kPstfSumMoments + 1u, each_directed),
                     moment_sum(sums + kPstfSumMoments + 2u, each_directed), incident.x > 0.0 ? directed : 0.0));

  pstf_cells.at[cell] =
      uvec4(head.x, pstf.frame_number, floatBitsToUint(samples / share), floatBitsToUint(before + samples));
  pstf_cells.at[cell + 1u] = floatBitsToUint(mix(outgoing, outgoing_now, blend) * scale);
  pstf_cells.at[cell + 2u] = floatBitsToUint(vec4(
      mix(colors.xy, color_sum(sums, each), blend) * scale,
      mix(colors.zw * scale_before, color_sum(sums + kPstfSumIncident, each_directed) * scale_now, directed_blend)));
  pstf_cells.at[cell + 3u] = floatBitsToUint(
      mix(incident * scale_before, light_sum(sums + kPstfSumIncident, each_directed) * scale_now, directed_blend));
  pstf_cells.at[cell + 4u] = floatBitsToUint(vec4(mix(normal.xyz, normal_now, blend), control.samples));
  pstf_cells.at[cell + 5u] =
      floatBitsToUint(vec4(control.gh, control.hh, control.gg, mix(moments.w, second_now, blend) * scale * scale));
  pstf_cells.at[cell + 6u] =
      uvec4(floatBitsToUint(straight_mean), part.y != 0u ? part.y : pstf_sums.at[sums + kPstfSumRegion], 0u, 0u);
}

void main() {
  uint touched = pstf_sums.at[pstf_count_at(pstf.frame_number)], stride = gl_NumWorkGroups.x * 64u;
  if (gl_GlobalInvocationID.x == 0u) pstf_sums.at[pstf_count_at(pstf.frame_number + 1u)] = 0u;
  for (uint i = gl_GlobalInvocationID.x; i < touched; i += stride) {
    uint slot = pstf_sums.at[pstf_list_at() + i], cell = slot * (kPstfCellWords / 4u);
    uint samples = pstf_sums.at[pstf_samples_at(slot)] & ~kPstfClaimed;
    if (samples > 0u) {
      fold_cell(slot, float(samples));
      for (uint word = 0u; word < kPstfSumWords; ++word) pstf_sums.at[pstf_sums_at(slot) + word] = 0u;
    } else {  // its owner did not come
      // Its crowd is not known yet: of 256 pixels' samples no more than 4096 are taken.
      float crowd = kFirstPixels * float(frame.spp);
      pstf_cells.at[cell] = uvec4(pstf_sums.at[pstf_claim_at(slot)], pstf.frame_number, floatBitsToUint(crowd), 0u);
      for (uint texel = 1u; texel < kPstfCellWords / 4u; ++texel) pstf_cells.at[cell + texel] = uvec4(0u);
      if (TREES) store_tree(slot, even_tree());
    }
    pstf_sums.at[pstf_samples_at(slot)] = 0u;
    pstf_sums.at[pstf_claim_at(slot)] = 0u;
  }
}
