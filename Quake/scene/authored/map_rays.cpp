#include "scene/authored/map_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/library/surface_names.h"
#include "world/bsp_query.h"

namespace fb::scene {

MapRays::MapRays(const formats::Bsp& bsp, std::vector<Submodel> submodels)
    : bsp_(bsp),
      submodels_(std::move(submodels)),
      kinds_(bsp.faces.size(), kOpaque),
      bounds_(bsp.faces.size()),
      polygons_(bsp.faces.size()) {
  for (std::size_t i = 0; i < bsp.faces.size(); ++i) {
    const formats::BspFace& face = bsp.faces[i];
    Polygon& polygon = polygons_[i];
    polygon.normal = bsp.planes[face.plane].normal * (face.back_side ? -1.0f : 1.0f);
    const vec3 n = glm::abs(polygon.normal);
    const int drop = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
    polygon.u = (drop + 1) % 3;
    polygon.v = (drop + 2) % 3;
    polygon.first = static_cast<std::uint32_t>(corners_.size());
    polygon.count = face.surfedge_count;
    for (std::uint32_t k = 0; k < face.surfedge_count; ++k) {
      const vec3& corner = bsp.face_vertex(face, k);
      bounds_[i].add(corner);
      corners_.emplace_back(corner[polygon.u], corner[polygon.v]);
    }
    const std::uint32_t texture = bsp.texinfos[bsp.faces[i].texinfo].texture;
    if (texture >= bsp.textures.size()) continue;
    const std::string& name = bsp.textures[texture].name;
    const LiquidKind liquid = liquid_kind(name);
    if (is_sky_texture(name))
      kinds_[i] = kSky;
    else if (is_tool_texture(name))
      kinds_[i] = kUnseen;
    else if (liquid == LiquidKind::kWater || liquid == LiquidKind::kSlime)
      kinds_[i] = kLiquid;
  }
}

vec3 MapRays::normal(std::uint32_t face) const { return polygons_[face].normal; }

bool MapRays::is_clear(const vec3& start, const vec3& end) const {
  const world::LineHit hit = world::trace_line(bsp_, start, end);
  return !hit.hit && !hit.start_solid;
}

// Its corners run one way round.
bool MapRays::contains(std::uint32_t face, const vec3& point) const {
  constexpr float kSlack = 0.05f;  // units: rays between two faces meet one of them
  const Bounds& within = bounds_[face];
  if (glm::any(glm::lessThan(point, within.min - 1.0f)) || glm::any(glm::greaterThan(point, within.max + 1.0f)))
    return false;
  const Polygon& polygon = polygons_[face];
  if (polygon.count < 3) return false;
  const vec2 at(point[polygon.u], point[polygon.v]);
  bool left = true, right = true;
  vec2 a = corners_[polygon.first + polygon.count - 1];
  for (std::uint32_t k = 0; k < polygon.count && (left || right); ++k) {
    const vec2 b = corners_[polygon.first + k], way = b - a;
    const float cross = way.x * (at.y - a.y) - way.y * (at.x - a.x);
    const float slack = kSlack * (std::fabs(way.x) + std::fabs(way.y));
    left &= cross >= -slack;
    right &= cross <= slack;
    a = b;
  }
  return left || right;
}

std::optional<std::uint32_t> MapRays::face_at(std::int32_t node, const vec3& point, const vec3& along,
                                              bool liquids) const {
  const formats::BspNode& n = bsp_.nodes[static_cast<std::size_t>(node)];
  for (std::uint32_t i = 0; i < n.face_count; ++i) {
    const std::uint32_t face = n.first_face + i;
    if (face >= bsp_.faces.size() || kinds_[face] == kUnseen || (kinds_[face] == kLiquid && !liquids)) continue;
    if (glm::dot(normal(face), along) < 0.0f && contains(face, point)) return face;
  }
  return std::nullopt;
}

bool MapRays::may_meet(const formats::BspModel& model, const vec3& start, const vec3& end) const {
  float from = 0.0f, to = 1.0f;
  for (int a = 0; a < 3; ++a) {
    const float way = end[a] - start[a];
    if (std::fabs(way) < 1e-6f) {
      if (start[a] < model.mins[a] - 1.0f || start[a] > model.maxs[a] + 1.0f) return false;
      continue;
    }
    const float one = (model.mins[a] - 1.0f - start[a]) / way, other = (model.maxs[a] + 1.0f - start[a]) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return from <= to;
}

std::optional<MapRays::Hit> MapRays::first_face(const vec3& start, const vec3& end, bool liquids) const {
  std::optional<Meeting> first = first_of(0, start, end, liquids);
  vec3 offset(0.0f);
  for (const Submodel& submodel : submodels_) {
    const vec3 from = start - submodel.offset, to = end - submodel.offset;
    if (!may_meet(bsp_.models[submodel.index], from, to)) continue;
    const auto met = first_of(submodel.index, from, to, liquids);
    if (!met || (first && first->fraction <= met->fraction)) continue;
    first = met;
    offset = submodel.offset;
  }
  if (!first) return std::nullopt;
  return Hit{first->face, start - offset + (end - start) * first->fraction, offset};
}

std::optional<MapRays::Meeting> MapRays::first_of(std::uint32_t model, const vec3& start, const vec3& end,
                                                  bool liquids) const {
  // Pieces of the line that remain, the nearest on top: trees may be too deep for recursion.
  thread_local std::vector<Piece> pieces;
  pieces.clear();
  pieces.push_back({bsp_.models[model].head_nodes[0], 0.0f, 1.0f, -1});
  const vec3 along = end - start;
  while (!pieces.empty()) {
    Piece piece = pieces.back();
    pieces.pop_back();
    if (piece.crossed >= 0) {
      const vec3 point = start + along * piece.from;
      if (const auto face = face_at(piece.crossed, point, along, liquids)) return Meeting{*face, piece.from};
    }
    while (piece.node >= 0) {
      const formats::BspNode& node = bsp_.nodes[static_cast<std::size_t>(piece.node)];
      const formats::BspPlane& plane = bsp_.planes[node.plane];
      const float d0 = glm::dot(plane.normal, start) - plane.distance,
                  d1 = glm::dot(plane.normal, end) - plane.distance;
      const float at_from = d0 + (d1 - d0) * piece.from, at_to = d0 + (d1 - d0) * piece.to;
      const std::size_t near_side = at_from >= 0.0f ? 0 : 1;
      if ((at_to >= 0.0f ? 0u : 1u) == near_side) {
        piece.node = node.children[near_side];
        continue;
      }
      const float split = std::clamp(d0 / (d0 - d1), piece.from, piece.to);
      pieces.push_back({node.children[1 - near_side], split, piece.to, piece.node});
      piece.node = node.children[near_side];
      piece.to = split;
    }
    const auto leaf = static_cast<std::size_t>(~piece.node);
    if (leaf >= bsp_.leafs.size() || bsp_.leafs[leaf].contents == formats::kContentsSolid) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace fb::scene
