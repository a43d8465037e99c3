// Finds the entities near a box: Quake's area nodes, a tree that halves the world's box four times along its longer
// horizontal side. An entity is linked at the deepest node whose half contains it completely, in one of two lists.
//
// The order is part of the game's behaviour: it decides which of two triggers is touched first, and which of two
// equally near entities is hit. An entity goes to the end of its list each time it is linked. A search visits a node's
// list from its beginning, then the upper half (above the node's distance), then the lower one (Misc/QUIRKS.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/maths.h"

namespace fb::world {

enum class AreaList : std::uint8_t { kSolid, kTrigger };

class AreaNodes {
 public:
  // The world model's box.
  AreaNodes(const vec3& world_mins, const vec3& world_maxs);

  // Links entity `id` (0 and up; memory grows with the largest) where its box belongs, at the end of the list, after
  // unlinking it from its former node.
  void link(int id, AreaList list, const Bounds& box);
  void unlink(int id);  // does nothing if it is not linked
  bool linked(int id) const;

  // Calls visit(id) for the entities in the nodes that the box reaches, in Quake's order, until visit returns false.
  // Boxes are not compared: the caller must do so, because QuakeC can change an entity's box without linking it again.
  // `visit` must not link or unlink: see collect. Returns false if visit did.
  template <typename Visit>
  bool visit(AreaList list, const Bounds& box, Visit&& visit) const {
    return visit_node(0, list, box, visit);
  }
  // The same as a list, which stays valid while entities are linked or unlinked. QuakeSpasm makes such a list before
  // the first trigger is touched. Appends to `ids`.
  void collect(AreaList list, const Bounds& box, std::vector<int>& ids) const;

 private:
  static constexpr int kDepth = 4;
  struct Node {
    int axis = -1;  // 0 or 1; -1: not divided
    float distance = 0.0f;
    std::array<int, 2> children{};  // above, below
  };
  // Rings: each list of a node has a link of its own that is both its ends.
  struct Link {
    int previous = -1, next = -1;  // -1: not in a ring
  };

  int make_node(int depth, const vec3& mins, const vec3& maxs);
  static int end_of(int node, AreaList list) { return 2 * node + (list == AreaList::kTrigger ? 1 : 0); }
  int link_of(int id) const { return 2 * static_cast<int>(nodes_.size()) + id; }
  Link& at(int link) { return links_[static_cast<std::size_t>(link)]; }
  const Link& at(int link) const { return links_[static_cast<std::size_t>(link)]; }

  template <typename Visit>
  bool visit_node(int index, AreaList list, const Bounds& box, Visit& visit) const {
    const int end = end_of(index, list);
    for (int link = at(end).next; link != end; link = at(link).next)
      if (!visit(link - link_of(0))) return false;
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.axis < 0) return true;
    if (box.max[node.axis] > node.distance && !visit_node(node.children[0], list, box, visit)) return false;
    return !(box.min[node.axis] < node.distance) || visit_node(node.children[1], list, box, visit);
  }

  std::vector<Node> nodes_;
  std::vector<Link> links_;  // the lists' ends, then a link for each id
};

// Whether two boxes intersect; boxes that touch do. Quake tests this before a trigger is touched or a move is clipped.
inline bool boxes_meet(const Bounds& a, const Bounds& b) {
  return !(a.min.x > b.max.x || a.min.y > b.max.y || a.min.z > b.max.z || a.max.x < b.min.x || a.max.y < b.min.y ||
           a.max.z < b.min.z);
}

}  // namespace fb::world
