// The tree over instances, built on the host each frame. The world, where there is one, hangs in it as it is: in parts
// of its own tree, beside the other instances, so that rays meet everything from near to far.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "shared/bvh.h"

namespace fb::render {

struct TreeLeaf {
  std::uint32_t ref = 0;  // an instance, or a part of the world's tree
  Bounds bounds;          // in the world
};

// Nodes in which references are the device's: the first node is node 0, the others stand from `first_node` on.
std::vector<shared::BvhNode> build_instance_tree(std::span<const TreeLeaf> leaves, std::uint32_t first_node);

inline std::uint32_t instance_ref(std::uint32_t index, std::uint32_t visibility) {
  return shared::kRefLeaf | shared::kRefInstance |
         (visibility & shared::kRefVisibilityMask) << shared::kRefVisibilityShift | index;
}

// Place along a Morton curve through `space`, 10 bits an axis.
std::uint32_t morton_code(const vec3& point, const Bounds& space);

}  // namespace fb::render
