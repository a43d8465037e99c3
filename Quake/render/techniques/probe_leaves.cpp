#include "render/techniques/probe_leaves.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "world/bsp_query.h"
#include "world/portals.h"
#include "world/pvs.h"

namespace fb::render {
namespace {

constexpr int kPlacesEachWay = 3;  // candidates for a probe's place along an axis, on each side of the middle

std::array<glm::ivec3, 343> places_by_distance() {
  std::array<glm::ivec3, 343> places;
  std::size_t count = 0;
  for (int z = -kPlacesEachWay; z <= kPlacesEachWay; ++z)
    for (int y = -kPlacesEachWay; y <= kPlacesEachWay; ++y)
      for (int x = -kPlacesEachWay; x <= kPlacesEachWay; ++x) places[count++] = {x, y, z};
  std::ranges::stable_sort(places, {}, [](const glm::ivec3& p) { return p.x * p.x + p.y * p.y + p.z * p.z; });
  return places;
}

// Bit 0: some of the box is in front of a plane or on it, bit 1: some is behind.
unsigned sides_of(const Bounds& box, const formats::BspPlane& plane) {
  const vec3 middle = 0.5f * (box.min + box.max), half = 0.5f * (box.max - box.min);
  const float height = glm::dot(plane.normal, middle) - plane.distance;
  const float reach = glm::dot(glm::abs(plane.normal), half) + 0.01f;
  return (height >= -reach ? 1u : 0u) | (height < reach ? 2u : 0u);
}

// Its middle and, a little within, its corners.
std::array<vec3, 9> points_of(const Bounds& box) {
  const vec3 middle = 0.5f * (box.min + box.max), half = 0.45f * (box.max - box.min);
  std::array<vec3, 9> points{middle};
  for (std::uint32_t i = 0; i < 8; ++i)
    points[i + 1] = middle + half * vec3((i & 1u) != 0 ? 1 : -1, (i & 2u) != 0 ? 1 : -1, (i & 4u) != 0 ? 1 : -1);
  return points;
}
// Whether every straight way across a leaf, from one of its openings to another, leads through one of these doors.
bool is_shut_off(const Bounds& from, const Bounds& to, std::span<const Bounds> doors) {
  Bounds both = from;
  both.add(to);
  return std::ranges::any_of(doors, [&](const Bounds& door) {
    if (!boxes_meet(both, door)) return false;
    for (const vec3& a : points_of(from))
      for (const vec3& b : points_of(to))
        if (!shared::ddgi_is_shut(a, b, door.min, door.max)) return false;
    return true;
  });
}

}  // namespace

bool boxes_meet(const Bounds& a, const Bounds& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) return false;
  return true;
}

LeafGraph::LeafGraph(std::shared_ptr<const formats::Bsp> bsp) : bsp_(std::move(bsp)) {
  open_of_leaf_.resize(bsp_->leafs.size(), 0);
  // Leafs of submodels come after the world's.
  const std::size_t most = std::min<std::size_t>(bsp_->leafs.size(), std::size_t{bsp_->models[0].visible_leafs} + 1);
  for (std::size_t i = 1; i < most; ++i) {
    if (!world::is_open(bsp_->leafs[i])) continue;
    leaf_of_open_.push_back(static_cast<std::uint32_t>(i));
    open_of_leaf_[i] = leafs();
  }
  std::vector<std::pair<std::uint32_t, Way>> ways;
  for (const world::Portal& portal : world::leaf_portals(*bsp_)) {
    const std::uint32_t a = open_of_leaf_[portal.front], b = open_of_leaf_[portal.back];
    if (a == 0 || b == 0 || a == b) continue;
    ways.push_back({a, {b, portal.bounds}});
    ways.push_back({b, {a, portal.bounds}});
  }
  std::ranges::stable_sort(ways, {}, [](const auto& way) { return way.first; });
  first_way_.resize(std::size_t{leafs()} + 2, 0);
  for (const auto& [from, way] : ways) {
    ++first_way_[from + 1];
    ways_.push_back(way);
  }
  for (std::size_t i = 1; i < first_way_.size(); ++i) first_way_[i] += first_way_[i - 1];
}

std::uint32_t LeafGraph::at(const vec3& point) const {
  const std::uint32_t leaf = world::point_in_leaf(*bsp_, point);
  return leaf < open_of_leaf_.size() ? open_of_leaf_[leaf] : 0;
}

std::optional<vec3> LeafGraph::open_place(const vec3& middle, const vec3& room) const {
  static const std::array<glm::ivec3, 343> kPlaces = places_by_distance();
  const Start start = start_in({middle - room, middle + room});
  if (start.at < 0) return start.at == ~0 ? std::nullopt : std::optional(middle);
  for (const glm::ivec3& place : kPlaces) {
    const vec3 point = middle + room * vec3(place) / static_cast<float>(kPlacesEachWay);
    if (at(point) != 0) return point;
  }
  return std::nullopt;
}

void LeafGraph::reached_from(const vec3& place, const Bounds& within, std::span<const Bounds> doors,
                             std::span<std::uint32_t> row) const {
  const std::uint32_t leaf = at(place);
  const world::LeafSet seen = world::leaf_pvs(*bsp_, leaf_of_open_[leaf - 1]);
  std::vector<bool> taken(ways_.size());
  struct Step {
    std::uint32_t leaf;
    Bounds entered;  // the opening, or where it began
  };
  std::vector<Step> next{{leaf, {place, place}}};
  while (!next.empty()) {
    const Step from = next.back();
    next.pop_back();
    row[from.leaf / 32] |= 1u << (from.leaf % 32);
    for (std::uint32_t i = first_way_[from.leaf]; i < first_way_[from.leaf + 1]; ++i) {
      const Way& way = ways_[i];
      if (taken[i] || !seen.contains(leaf_of_open_[way.to - 1]) || !boxes_meet(way.bounds, within) ||
          is_shut_off(from.entered, way.bounds, doors))
        continue;
      taken[i] = true;
      next.push_back({way.to, way.bounds});
    }
  }
}

std::int32_t LeafGraph::child(const formats::BspNode& node, int side) const {
  const std::int32_t at = node.children[static_cast<std::size_t>(side)];
  if (at >= 0) return at;
  const auto leaf = static_cast<std::size_t>(~at);
  return ~static_cast<std::int32_t>(leaf < open_of_leaf_.size() ? open_of_leaf_[leaf] : 0);
}

LeafGraph::Start LeafGraph::start_in(const Bounds& box) const {
  std::int32_t at = bsp_->models[0].head_nodes[0];
  if (at < 0) return {~static_cast<std::int32_t>(open_of_leaf_[static_cast<std::size_t>(~at)]), 0};
  while (at >= 0) {
    const formats::BspNode& node = bsp_->nodes[static_cast<std::size_t>(at)];
    const unsigned sides = sides_of(box, bsp_->planes[node.plane]);
    if (sides == 3) break;
    at = child(node, sides == 1 ? 0 : 1);
  }
  return {at, steps_in(at, box)};
}

std::uint32_t LeafGraph::steps_in(std::int32_t at, const Bounds& box) const {
  if (at < 0) return 0;
  const formats::BspNode& node = bsp_->nodes[static_cast<std::size_t>(at)];
  const unsigned sides = sides_of(box, bsp_->planes[node.plane]);
  const std::uint32_t front = (sides & 1u) != 0 ? steps_in(child(node, 0), box) : 0;
  const std::uint32_t back = (sides & 2u) != 0 ? steps_in(child(node, 1), box) : 0;
  return 1 + std::max(front, back);
}

std::vector<shared::uvec4> LeafGraph::nodes() const {
  std::vector<shared::uvec4> words;
  words.reserve(2 * bsp_->nodes.size());
  for (const formats::BspNode& node : bsp_->nodes) {
    const formats::BspPlane& plane = bsp_->planes[node.plane];
    const auto word = [](float f) { return std::bit_cast<std::uint32_t>(f); };
    words.emplace_back(word(plane.normal.x), word(plane.normal.y), word(plane.normal.z), word(plane.distance));
    words.emplace_back(static_cast<std::uint32_t>(child(node, 0)), static_cast<std::uint32_t>(child(node, 1)), 0, 0);
  }
  return words;
}

}  // namespace fb::render
