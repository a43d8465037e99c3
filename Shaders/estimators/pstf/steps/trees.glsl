// Step `trees`: what cells draw directions from, of light times BSDF as paths' own directions bring it: k-d trees over
// directions (estimators/pstf/pstf_tree.h) or, as is set, mixtures of Gaussians (estimators/pstf/pstf_gaussians.h).
#ifndef FB_PSTF_TREES
#define FB_PSTF_TREES
#include "estimators/pstf/pstf_gaussians.h"
#include "estimators/pstf/pstf_tree.h"
#include "estimators/pstf/steps/cells.glsl"

FB_TECHNIQUE_ARRAY(kPstfTreeSums, 4, , PstfTreeSumArray, uint, pstf_tree_sums)
layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kPstfTrees) uniform usamplerBuffer pstf_tree_texels;
layout(set = kSetScene,
       binding = kBindTexelBuffers + kTexelsTechnique + kPstfGaussians) uniform usamplerBuffer pstf_gaussian_texels;
FB_TECHNIQUE_ARRAY(kPstfSamples, 4, , PstfSampleArray, uint, pstf_samples)

layout(constant_id = kSpecGaussians) const uint GAUSSIANS = 0u;  // of a cell; 0: it has a tree
const bool kHasTrees = true;
const float kTreeTaught = 32.0;  // samples after which a cell's tree draws directions

struct CellTree {
  uint leaf[kTreeLeaves];
  uint slot;
};

CellTree load_tree(uint slot) {
  CellTree tree;
  tree.slot = slot;
  if (GAUSSIANS != 0u) return tree;
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

Gaussian load_gaussian(uint slot, uint i) {
  int at = int(2u * (slot * GAUSSIANS + i));
  vec4 a = uintBitsToFloat(texelFetch(pstf_gaussian_texels, at)),
       b = uintBitsToFloat(texelFetch(pstf_gaussian_texels, at + 1));
  return Gaussian(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}
float mixture_pdf(uint slot, vec3 direction) {
  vec2 p = equal_area_from_direction(direction);
  float pdf = 0.0;
  uint i = 0u;
  [[dont_unroll]] do pdf += gaussian_density(load_gaussian(slot, i), p);
  while (++i < GAUSSIANS)
    ;
  return pdf;
}
vec3 mixture_draw(uint slot, vec2 u) {
  Gaussian drawn = load_gaussian(slot, 0u);
  float before = drawn.weight, start = 0.0;
  uint i = 1u;
  [[dont_unroll]] do {
    Gaussian g = load_gaussian(slot, i);
    if (before <= u.x) {
      drawn = g;
      start = before;
    }
    before += g.weight;
  }
  while (++i < GAUSSIANS)
    ;
  float within = clamp((u.x - start) / max(drawn.weight, 1e-6), 0.0, 0.99999994);
  return direction_from_equal_area(gaussian_draw(drawn, vec2(within, u.y)));
}

float directions_pdf(CellTree tree, vec3 direction) {
  return GAUSSIANS != 0u ? mixture_pdf(tree.slot, direction) : tree_pdf(direction_tree(tree), direction);
}
vec3 directions_draw(CellTree tree, vec2 u) {
  return GAUSSIANS != 0u ? mixture_draw(tree.slot, u) : tree_sample(direction_tree(tree), u);
}

// `light`: f cos / pdf of a sample, luminance.
void teach_directions(uint slot, CellTree tree, vec3 direction, float light, uint bits) {
  if (GAUSSIANS != 0u) {
    uint word = sample_word(equal_area_from_direction(direction), light, rng_uniform(bits), hash_combine(bits, 1u));
    if (word != 0u) atomicMax(pstf_samples.at[slot * kGaussianPlaces + hash_combine(bits, 2u) % kGaussianPlaces], word);
    return;
  }
  uint leaf = leaf_of_place(direction_tree(tree), tree_place(direction));
  uint x = fixed_point(light, kPstfSteps, 0.0, kPstfLargest, rng_uniform(bits));
  if (x != 0u) atomicAdd(pstf_tree_sums.at[slot * kTreeLeaves + leaf], x);
}
#endif
