#include "world/hull.h"

#include "base/check.h"

namespace fb::world {
namespace {

// The boxes by which map compilers expand hulls 1 and 2.
constexpr std::array<std::array<vec3, 2>, kHullCount> kClipBoxes = {
    {{vec3(0.0f), vec3(0.0f)}, {vec3(-16, -16, -24), vec3(16, 16, 32)}, {vec3(-32, -32, -24), vec3(32, 32, 64)}}};

HullNode node_of(const formats::BspPlane& plane) { return {plane.normal, plane.distance, plane.type, {}}; }

}  // namespace

MapHulls::MapHulls(const formats::Bsp& bsp) {
  const auto contents_of = [&](std::int32_t child) {
    return child >= 0 ? child : bsp.leafs[static_cast<std::size_t>(~child)].contents;
  };
  nodes_.reserve(bsp.nodes.size());
  for (const formats::BspNode& node : bsp.nodes) {
    nodes_.push_back(node_of(bsp.planes[node.plane]));
    nodes_.back().children = {contents_of(node.children[0]), contents_of(node.children[1])};
  }
  clip_nodes_.reserve(bsp.clip_nodes.size());
  for (const formats::BspClipNode& node : bsp.clip_nodes) {
    clip_nodes_.push_back(node_of(bsp.planes[node.plane]));
    clip_nodes_.back().children = node.children;
  }
  heads_.reserve(bsp.models.size());
  for (const formats::BspModel& model : bsp.models) {
    heads_.push_back({contents_of(model.head_nodes[0]), model.head_nodes[1], model.head_nodes[2]});
  }
}

Hull MapHulls::hull(std::uint32_t model, int which) const {
  FB_CHECK_LT(model, heads_.size());
  FB_CHECK(which >= 0 && which < kHullCount);
  const auto index = static_cast<std::size_t>(which);
  return {which == 0 ? nodes_ : clip_nodes_, heads_[model][index], kClipBoxes[index][0], kClipBoxes[index][1]};
}

int hull_for_size(const vec3& size) {
  if (size.x < 3.0f) return 0;
  return size.x <= 32.0f ? 1 : 2;
}

BoxHull::BoxHull(const vec3& mins, const vec3& maxs) {
  // Upper and lower planes of x, y, z in turn: outside of any is empty, inside of all six is solid.
  for (std::int32_t i = 0; i < 6; ++i) {
    HullNode& node = nodes_[static_cast<std::size_t>(i)];
    const int axis = i / 2;
    const bool upper = i % 2 == 0;
    node.normal[axis] = 1.0f;
    node.type = axis;
    node.distance = (upper ? maxs : mins)[axis];
    node.children[upper ? 0 : 1] = formats::kContentsEmpty;
    node.children[upper ? 1 : 0] = i < 5 ? i + 1 : static_cast<std::int32_t>(formats::kContentsSolid);
  }
}

std::int32_t true_point_contents(const MapHulls& map, const vec3& p) { return hull_point_contents(map.hull(0, 0), p); }

std::int32_t sv_point_contents(const MapHulls& map, const vec3& p) {
  const std::int32_t contents = true_point_contents(map, p);
  const bool current = contents <= formats::kContentsCurrent0 && contents >= formats::kContentsCurrentDown;
  return current ? static_cast<std::int32_t>(formats::kContentsWater) : contents;
}

}  // namespace fb::world
