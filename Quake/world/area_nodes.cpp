#include "world/area_nodes.h"

#include "base/check.h"

namespace fb::world {

AreaNodes::AreaNodes(const vec3& world_mins, const vec3& world_maxs) {
  make_node(0, world_mins, world_maxs);
  links_.resize(2 * nodes_.size());
  for (int end = 0; end < static_cast<int>(links_.size()); ++end) at(end) = {end, end};
}

int AreaNodes::make_node(int depth, const vec3& mins, const vec3& maxs) {
  const auto index = nodes_.size();
  nodes_.emplace_back();
  if (depth == kDepth) return static_cast<int>(index);
  const vec3 size = maxs - mins;
  const int axis = size.x > size.y ? 0 : 1;
  const float distance = 0.5f * (maxs[axis] + mins[axis]);
  vec3 above_mins = mins, below_maxs = maxs;
  above_mins[axis] = below_maxs[axis] = distance;
  const int above = make_node(depth + 1, above_mins, maxs);
  const int below = make_node(depth + 1, mins, below_maxs);
  nodes_[index] = {axis, distance, {above, below}};
  return static_cast<int>(index);
}

void AreaNodes::link(int id, AreaList list, const Bounds& box) {
  FB_CHECK_LE(0, id);
  unlink(id);
  int index = 0;
  while (true) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.axis < 0) break;
    if (box.min[node.axis] > node.distance) {
      index = node.children[0];
    } else if (box.max[node.axis] < node.distance) {
      index = node.children[1];
    } else {
      break;
    }
  }
  const int link = link_of(id), end = end_of(index, list);
  if (static_cast<std::size_t>(link) >= links_.size()) links_.resize(static_cast<std::size_t>(link) + 1);
  at(link) = {at(end).previous, end};
  at(at(end).previous).next = link;
  at(end).previous = link;
}

void AreaNodes::unlink(int id) {
  if (!linked(id)) return;
  Link& link = at(link_of(id));
  at(link.previous).next = link.next;
  at(link.next).previous = link.previous;
  link = {};
}

bool AreaNodes::linked(int id) const {
  FB_CHECK_LE(0, id);
  const auto link = static_cast<std::size_t>(link_of(id));
  return link < links_.size() && links_[link].next >= 0;
}

void AreaNodes::collect(AreaList list, const Bounds& box, std::vector<int>& ids) const {
  visit(list, box, [&](int id) {
    ids.push_back(id);
    return true;
  });
}

}  // namespace fb::world
