// Hulls built in code, for tests of this module.
#pragma once

#include <vector>

#include "base/rng.h"
#include "world/hull.h"

namespace fb::world::testing {

// Nodes, and a hull that refers to them.
struct OwnedHull {
  std::vector<HullNode> nodes;
  std::int32_t first = 0;
  Hull hull() const { return {nodes, first, vec3(0.0f), vec3(0.0f)}; }
};

inline HullNode axial(int axis, float distance, std::int32_t front, std::int32_t back) {
  HullNode node{vec3(0.0f), distance, axis, {front, back}};
  node.normal[axis] = 1.0f;
  return node;
}

// A tree of `depth` levels of random planes, along axes and slanted, within some 200 units around the origin; a third
// of its leafs are solid, the rest empty or water.
inline OwnedHull random_hull(Rng& rng, int depth) {
  OwnedHull made;
  const auto grow = [&](auto&& self, int levels) -> std::int32_t {
    if (levels == 0) {
      constexpr std::int32_t kKinds[] = {formats::kContentsSolid, formats::kContentsEmpty, formats::kContentsWater};
      return kKinds[rng.below(3)];
    }
    const auto index = made.nodes.size();
    made.nodes.emplace_back();
    const int axis = static_cast<int>(rng.below(6));
    HullNode node = axial(axis % 3, rng.uniform(-200.0f, 200.0f), 0, 0);
    if (axis >= 3) {
      node.normal = glm::normalize(vec3(rng.uniform(-1.0f, 1.0f), rng.uniform(-1.0f, 1.0f), rng.uniform(-1.0f, 1.0f)) +
                                   vec3(1e-3f));
      node.type = axis;
    }
    node.children[0] = self(self, levels - 1);
    node.children[1] = self(self, levels - 1);
    made.nodes[index] = node;
    return static_cast<std::int32_t>(index);
  };
  made.first = grow(grow, depth);
  return made;
}

inline vec3 random_point(Rng& rng, float reach) {
  const float x = rng.uniform(-reach, reach), y = rng.uniform(-reach, reach);
  return {x, y, rng.uniform(-reach, reach)};
}

}  // namespace fb::world::testing
