// The tree check of parse_bsp. It refuses cycles and excessive depth, so that later code may walk a map's trees
// recursively.
#include "formats/bsp_detail.h"

namespace fb::formats::detail {

std::optional<TreeFault> find_tree_fault(const std::vector<std::array<std::int32_t, 2>>& children,
                                         bool shared_allowed) {
  const std::size_t count = children.size();
  std::vector<std::uint8_t> has_parent(count, 0);
  for (std::size_t n = 0; n < count; ++n) {
    for (const std::int32_t child : children[n]) {
      if (child < 0) continue;
      std::uint8_t& mark = has_parent[static_cast<std::size_t>(child)];
      if (mark != 0 && !shared_allowed) return TreeFault{n, "node has a child that has another parent"};
      mark = 1;
    }
  }

  // height 0: not visited yet; kOpen: on the current path.
  constexpr std::uint32_t kOpen = 0xffffffffu;
  struct Step {
    std::uint32_t node;
    std::uint32_t next_child;
  };
  std::vector<std::uint32_t> height(count, 0);
  std::vector<Step> path;
  for (std::size_t root = 0; root < count; ++root) {
    if (height[root] != 0) continue;
    path.push_back({static_cast<std::uint32_t>(root), 0});
    height[root] = kOpen;
    while (!path.empty()) {
      const Step step = path.back();
      if (step.next_child < 2) {
        ++path.back().next_child;
        const std::int32_t child = children[step.node][step.next_child];
        if (child < 0) continue;
        const auto next = static_cast<std::uint32_t>(child);
        if (height[next] == kOpen) return TreeFault{step.node, "node leads back to itself"};
        if (height[next] == 0) {
          height[next] = kOpen;
          path.push_back({next, 0});
        }
        continue;
      }
      std::uint32_t tallest = 0;
      for (const std::int32_t child : children[step.node]) {
        if (child >= 0) tallest = std::max(tallest, height[static_cast<std::size_t>(child)]);
      }
      if (tallest >= kMaxBspDepth) return TreeFault{step.node, "node tree is deeper than any may be"};
      height[step.node] = tallest + 1;
      path.pop_back();
    }
  }
  return std::nullopt;
}

}  // namespace fb::formats::detail
