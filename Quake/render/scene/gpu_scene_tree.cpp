#include "render/scene/gpu_scene_tree.h"

#include <algorithm>

#include "gpu/bvh.h"

namespace fb::render {
namespace {

static_assert(shared::kMaxMeshDepth + shared::kMaxInstanceDepth <= shared::kTraversalDepth);

std::uint32_t spread_bits(std::uint32_t v) {
  std::uint32_t spread = 0;
  for (std::uint32_t bit = 0; bit < 10; ++bit) spread |= (v >> bit & 1u) << (3 * bit);
  return spread;
}

}  // namespace

std::vector<shared::BvhNode> build_instance_tree(std::span<const TreeLeaf> leaves, std::uint32_t first_node) {
  std::vector<Bounds> boxes;
  boxes.reserve(leaves.size());
  for (const TreeLeaf& leaf : leaves) boxes.push_back(leaf.bounds);
  gpu::Bvh bvh = gpu::build_bvh(boxes, {.max_leaf = 1, .max_depth = shared::kMaxInstanceDepth});
  if (bvh.nodes.empty()) {  // one leaf alone
    shared::BvhNode root{boxes[0].min, leaves[0].ref, boxes[0].max, 0, vec3(0.0f), 0, vec3(0.0f), 0};
    gpu::set_empty_child(root, 1);
    return {root};
  }
  if (leaves.empty()) return std::move(bvh.nodes);
  for (shared::BvhNode& node : bvh.nodes) {
    for (std::uint32_t* child : {&node.child0, &node.child1}) {
      *child =
          *child < shared::kRefLeaf ? *child + first_node - 1 : leaves[bvh.order[*child & shared::kRefFirstMask]].ref;
    }
  }
  return std::move(bvh.nodes);
}

std::uint32_t morton_code(const vec3& point, const Bounds& space) {
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    float extent = space.max[axis] - space.min[axis];
    float at = extent > 0.0f ? (point[axis] - space.min[axis]) / extent * 1024.0f : 0.0f;
    auto cell = static_cast<std::uint32_t>(std::clamp(at, 0.0f, 1023.0f));
    code |= spread_bits(cell) << axis;
  }
  return code;
}

}  // namespace fb::render
