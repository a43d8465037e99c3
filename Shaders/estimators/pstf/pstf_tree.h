// A k-d tree over all directions with a fixed number of leaves (Pantaleoni 2020, Section 2.6.2): which leaf a direction
// is in, density and sampling, and how leaves split and collapse. C++ and GLSL.
//
// The square of the equal-area map of the sphere (shared/equal_area.h) is halved along x and y in turns. A
// leaf of depth d is those places whose first d bits, of x and y in turns, are its own. Leaves stand in the order of
// their places, so that a place is in the last leaf that begins at or before it.
#ifndef FB_PSTF_TREE_H
#define FB_PSTF_TREE_H
#include "shared/equal_area.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kTreeLeaves = 16u, kTreeDepth = 15u;
FB_CONST uint kTreeParts = 8191u;  // that all probabilities add up to

// 128 bytes with the mean light of each leaf. A leaf's word: where it begins (15 bits), depth (4), probability (13).
struct DirectionTree {
  uint leaf[16];
  float light[16];
};
FB_FN uint tree_leaf(uint begins, uint depth, uint parts) { return begins << 17u | depth << 13u | parts; }
FB_FN uint leaf_begin(uint leaf) { return leaf >> 17u; }
FB_FN uint leaf_depth(uint leaf) { return (leaf >> 13u) & 15u; }
FB_FN uint leaf_parts(uint leaf) { return leaf & 8191u; }

// Of a direction: eight bits of x and seven of y in turns, x first.
FB_FN uint tree_place(vec3 direction) {
  vec2 p = equal_area_from_direction(direction);
  uint x = uint(clamp((p.x + 1.0f) * 128.0f, 0.0f, 255.0f)), y = uint(clamp((p.y + 1.0f) * 64.0f, 0.0f, 127.0f));
  uint place = 0u;
  for (uint i = 0u; i < 7u; ++i) place = place << 2u | ((x >> (7u - i)) & 1u) << 1u | ((y >> (6u - i)) & 1u);
  return place << 1u | (x & 1u);
}
// The direction at a place in [0, 1)^2 of a leaf.
FB_FN vec3 leaf_direction(uint leaf, vec2 within) {
  uint depth = leaf_depth(leaf), begins = leaf_begin(leaf);
  uint x = 0u, y = 0u;
  for (uint i = 0u; i < 8u; ++i) x = x << 1u | ((begins >> (14u - 2u * i)) & 1u);
  for (uint i = 0u; i < 7u; ++i) y = y << 1u | ((begins >> (13u - 2u * i)) & 1u);
  float wide = exp2(float(8u - ((depth + 1u) >> 1u))), high = exp2(float(7u - (depth >> 1u)));
  return direction_from_equal_area(
      vec2((float(x) + within.x * wide) / 128.0f - 1.0f, (float(y) + within.y * high) / 64.0f - 1.0f));
}
// Per solid angle.
FB_FN float leaf_density(uint leaf) {
  return float(leaf_parts(leaf)) * exp2(float(leaf_depth(leaf))) / (float(kTreeParts) * 4.0f * kSpherePi);
}

FB_FN uint leaf_of_place(DirectionTree t, uint place) {
  uint found = 0u;
  for (uint i = 1u; i < kTreeLeaves; ++i) found = leaf_begin(t.leaf[i]) <= place ? i : found;
  return found;
}
FB_FN float tree_pdf(DirectionTree t, vec3 direction) {
  uint place = tree_place(direction), leaf = t.leaf[0];
  for (uint i = 1u; i < kTreeLeaves; ++i) leaf = leaf_begin(t.leaf[i]) <= place ? t.leaf[i] : leaf;
  return leaf_density(leaf);
}
// A direction of density tree_pdf; u in [0, 1)^2. At the very edge of a leaf rounding may put it into the next one.
FB_FN vec3 tree_sample(DirectionTree t, vec2 u) {
  float parts = u.x * float(kTreeParts);
  float before = 0.0f, start = 0.0f;
  uint leaf = t.leaf[0];
  for (uint i = 0u; i < kTreeLeaves; ++i) {
    float own = float(leaf_parts(t.leaf[i]));
    if (own > 0.0f && before <= parts) {
      leaf = t.leaf[i];
      start = before;
    }
    before += own;
  }
  float within = min((parts - start) / max(float(leaf_parts(leaf)), 1.0f), 0.99999994f);
  return leaf_direction(leaf, vec2(within, u.y));
}

// As a tree begins: even.
FB_FN DirectionTree even_tree() {
  DirectionTree t;
  for (uint i = 0u; i < kTreeLeaves; ++i) {
    uint parts = (i + 1u) * kTreeParts / kTreeLeaves - i * kTreeParts / kTreeLeaves;
    t.leaf[i] = tree_leaf(i << 11u, 4u, parts);
    t.light[i] = 0.0f;
  }
  return t;
}

// Whether a leaf and the next one are the halves of one.
FB_FN bool are_halves(uint a, uint b) {
  uint depth = leaf_depth(a);
  if (depth == 0u || depth != leaf_depth(b)) return false;
  uint bit = 1u << (kTreeDepth - depth);
  return (leaf_begin(a) & bit) == 0u && leaf_begin(b) == (leaf_begin(a) | bit);
}

// If the brightest leaf is more than `ratio` times as bright as the darkest two halves of one, it splits, and they
// collapse. True: so it was.
FB_FN bool split_and_collapse(FB_INOUT(DirectionTree, t), float ratio) {
  uint brightest = kTreeLeaves, darkest = kTreeLeaves;
  for (uint i = 0u; i < kTreeLeaves; ++i)
    if (leaf_depth(t.leaf[i]) < kTreeDepth &&
        (brightest == kTreeLeaves || t.light[i] > t.light[brightest < kTreeLeaves ? brightest : 0u]))
      brightest = i;
  float least = 0.0f;
  for (uint i = 0u; i + 1u < kTreeLeaves; ++i) {
    float both = t.light[i] + t.light[i + 1u];
    if (i == brightest || i + 1u == brightest || !are_halves(t.leaf[i], t.leaf[i + 1u])) continue;
    if (darkest == kTreeLeaves || both < least) {
      darkest = i;
      least = both;
    }
  }
  if (brightest == kTreeLeaves || darkest == kTreeLeaves || !(t.light[brightest] > ratio * least)) return false;
  DirectionTree former = t;
  uint to = 0u;
  for (uint from = 0u; from < kTreeLeaves; ++from) {
    uint leaf = former.leaf[from], depth = leaf_depth(leaf);
    float light = former.light[from];
    if (from == darkest) {
      t.leaf[to] = tree_leaf(leaf_begin(leaf), depth - 1u, 0u);
      t.light[to] = least;
      ++from;
    } else if (from == brightest) {
      t.leaf[to] = tree_leaf(leaf_begin(leaf), depth + 1u, 0u);
      t.light[to] = 0.5f * light;
      ++to;
      t.leaf[to] = tree_leaf(leaf_begin(leaf) | 1u << (kTreeDepth - depth - 1u), depth + 1u, 0u);
      t.light[to] = 0.5f * light;
    } else {
      t.leaf[to] = leaf;
      t.light[to] = light;
    }
    ++to;
  }
  return true;
}

// Probabilities in proportion to leaves' light; without any, to their sizes.
FB_FN void set_probabilities(FB_INOUT(DirectionTree, t)) {
  float sum = 0.0f, before = 0.0f;
  for (uint i = 0u; i < kTreeLeaves; ++i) sum += t.light[i];
  uint parts = 0u;
  for (uint i = 0u; i < kTreeLeaves; ++i) {
    before += sum > 0.0f ? t.light[i] / sum : exp2(-float(leaf_depth(t.leaf[i])));
    uint to = i + 1u == kTreeLeaves ? kTreeParts : min(uint(before * float(kTreeParts) + 0.5f), kTreeParts);
    to = max(to, parts);
    t.leaf[i] = tree_leaf(leaf_begin(t.leaf[i]), leaf_depth(t.leaf[i]), to - parts);
    parts = to;
  }
}

FB_NAMESPACE_END
#endif
