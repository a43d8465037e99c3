// Step `trees`: cells' k-d trees over directions (estimators/pstf/pstf_tree.h), of light times BSDF as paths' own
// directions bring it.
#ifndef FB_PSTF_TREES
#define FB_PSTF_TREES
#include "estimators/pstf/pstf_tree.h"
#include "estimators/pstf/steps/cells.glsl"

FB_TECHNIQUE_ARRAY(kPstfTreeSums, 4, , PstfTreeSumArray, uint, pstf_tree_sums)
layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kPstfTrees) uniform usamplerBuffer pstf_tree_texels;

const bool kHasTrees = true;
const float kTreeTaught = 32.0;  // samples after which a cell's tree draws directions

struct CellTree {
  uint leaf[kTreeLeaves];
};

CellTree load_tree(uint slot) {
  CellTree tree;
  for (uint i = 0u; i < kTreeLeaves / 4u; ++i) {
    uvec4 four = texelFetch(pstf_tree_texels, int(slot * (2u * kTreeLeaves / 4u) + i));
    for (uint k = 0u; k < 4u; ++k) tree.leaf[4u * i + k] = four[k];
  }
  return tree;
}
DirectionTree direction_tree(CellTree tree) {
  DirectionTree t;
  for (uint i = 0u; i < kTreeLeaves; ++i) {
    t.leaf[i] = tree.leaf[i];
    t.light[i] = 0.0;
  }
  return t;
}
uint taught_leaf(CellTree tree, vec3 direction) { return leaf_of_place(direction_tree(tree), tree_place(direction)); }

// `light`: f cos / pdf of a sample, luminance.
void teach_leaf(uint slot, uint leaf, float light, uint bits) {
  uint x = fixed_point(light, kPstfSteps, 0.0, kPstfLargest, rng_uniform(bits));
  if (x != 0u) atomicAdd(pstf_tree_sums.at[slot * kTreeLeaves + leaf], x);
}
#endif
