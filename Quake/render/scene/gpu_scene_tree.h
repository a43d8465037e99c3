// The top of the tree, built on the host each frame: over the parts of the world's tree and the trees of all copies, so
// that rays meet everything from near to far.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "shared/bvh.h"

namespace fb::render {

struct TreeLeaf {
  std::uint32_t ref = 0;  // a tree, as the device refers to it
  Bounds bounds;
};

// Nodes in which references are the device's: the first node is node 0, the others stand from `first_node` on.
std::vector<shared::BvhNode> build_instance_tree(std::span<const TreeLeaf> leaves, std::uint32_t first_node);

// Place along a Morton curve through `space`, 10 bits an axis.
std::uint32_t morton_code(const vec3& point, const Bounds& space);

}  // namespace fb::render
