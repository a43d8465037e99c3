// Host-side builder of the trees that shaders traverse (Shaders/shared/bvh.h): binned surface area heuristic (Wald
// 2007) over boxes. Deterministic; the depth is bounded, so that a traversal's stack is; whatever finite boxes come in
// (coincident, flat, huge), a valid tree comes out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "shared/bvh.h"

namespace fb::gpu {

struct BvhOptions {
  std::uint32_t max_leaf = 4;                       // primitives a leaf, at most shared::kMaxLeafTriangles
  std::uint32_t max_depth = shared::kMaxMeshDepth;  // inner nodes on a way from the root to a leaf
  float primitive_cost = 1.0f;                      // against a node's, which is 1
};

// References are relative: nodes index `nodes`, leaves index `order`.
struct Bvh {
  std::vector<shared::BvhNode> nodes;
  std::vector<std::uint32_t> order;  // primitives as leaves hold them, near ones together
  // For refitting: nodes by depth, and where each depth starts in that list; the last entry is the number of nodes.
  std::vector<std::uint32_t> level_order, level_first;
  std::uint32_t root = 0;  // a reference: a leaf if everything fits one
  std::uint32_t depth = 0;
  Bounds bounds;
};

// An empty list gives a root node with two empty boxes.
Bvh build_bvh(std::span<const Bounds> primitives, const BvhOptions& options);

// Expected cost of a ray that meets the tree's box, in node visits (the surface area heuristic's measure).
double bvh_cost(const Bvh& bvh, float primitive_cost);

// A box that no ray hits.
void set_empty_child(shared::BvhNode& node, int child);

}  // namespace fb::gpu
