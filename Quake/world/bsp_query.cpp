#include "world/bsp_query.h"

#include "base/check.h"

namespace fb::world {
namespace {

float plane_side(const formats::Bsp& bsp, std::uint32_t plane, const vec3& point) {
  const formats::BspPlane& p = bsp.planes[plane];
  return glm::dot(p.normal, point) - p.distance;
}

}  // namespace

std::uint32_t point_in_leaf(const formats::Bsp& bsp, const vec3& point, std::uint32_t model) {
  FB_CHECK_LT(model, bsp.models.size());
  std::int32_t at = bsp.models[model].head_nodes[0];
  while (at >= 0) {
    const formats::BspNode& node = bsp.nodes[static_cast<std::size_t>(at)];
    at = node.children[plane_side(bsp, node.plane, point) >= 0.0f ? 0 : 1];
  }
  return static_cast<std::uint32_t>(~at);
}

std::int32_t point_contents(const formats::Bsp& bsp, const vec3& point, std::uint32_t model) {
  const std::uint32_t leaf = point_in_leaf(bsp, point, model);
  return leaf < bsp.leafs.size() ? bsp.leafs[leaf].contents : formats::kContentsSolid;
}

std::vector<bool> leaf_visibility(const formats::Bsp& bsp, std::uint32_t leaf) {
  const std::size_t count = bsp.leafs.size();
  if (leaf == 0 || leaf >= count || bsp.visibility.empty() || bsp.leafs[leaf].vis_offset < 0)
    return std::vector<bool>(count, true);
  std::vector<bool> visible(count, false);
  // A row of bits for leafs 1 and up; a zero byte is followed by the number of zero bytes that it represents.
  std::size_t at = static_cast<std::size_t>(bsp.leafs[leaf].vis_offset);
  for (std::size_t bit = 0; bit + 1 < count && at < bsp.visibility.size(); ++at) {
    const unsigned bits = bsp.visibility[at];
    if (bits == 0) {
      if (++at >= bsp.visibility.size() || bsp.visibility[at] == 0) break;  // a run of length 0 would never end
      bit += 8u * bsp.visibility[at];
      continue;
    }
    for (unsigned k = 0; k < 8 && bit + k + 1 < count; ++k)
      if ((bits >> k) & 1u) visible[bit + k + 1] = true;
    bit += 8;
  }
  return visible;
}

double face_area(const formats::Bsp& bsp, const formats::BspFace& face) {
  vec3 sum(0.0f);
  for (std::uint32_t k = 1; k + 1 < face.surfedge_count; ++k)
    sum += glm::cross(bsp.face_vertex(face, k) - bsp.face_vertex(face, 0),
                      bsp.face_vertex(face, k + 1) - bsp.face_vertex(face, 0));
  return 0.5 * static_cast<double>(glm::length(sum));
}

LineHit trace_line(const formats::Bsp& bsp, const vec3& start, const vec3& end, std::uint32_t model) {
  FB_CHECK_LT(model, bsp.models.size());
  LineHit result;
  // Segments of the line that remain to be tested, nearest on top: an explicit stack, because trees of bad maps may be
  // too deep for recursion.
  struct Piece {
    std::int32_t node;
    float from, to;
    vec3 normal;  // of the plane at `from`
  };
  std::vector<Piece> pieces{{bsp.models[model].head_nodes[0], 0.0f, 1.0f, vec3(0.0f)}};
  bool first = true, was_solid = false;
  while (!pieces.empty()) {
    Piece piece = pieces.back();
    pieces.pop_back();
    while (piece.node >= 0) {
      const formats::BspNode& node = bsp.nodes[static_cast<std::size_t>(piece.node)];
      const float d0 = plane_side(bsp, node.plane, start), d1 = plane_side(bsp, node.plane, end);
      const float at_from = d0 + (d1 - d0) * piece.from, at_to = d0 + (d1 - d0) * piece.to;
      const int near_side = at_from >= 0.0f ? 0 : 1;
      if ((at_to >= 0.0f ? 0 : 1) == near_side) {
        piece.node = node.children[static_cast<std::size_t>(near_side)];
        continue;
      }
      const float split = glm::clamp(d0 / (d0 - d1), piece.from, piece.to);
      const vec3 normal = bsp.planes[node.plane].normal;
      pieces.push_back(
          {node.children[static_cast<std::size_t>(1 - near_side)], split, piece.to, near_side == 0 ? normal : -normal});
      piece.node = node.children[static_cast<std::size_t>(near_side)];
      piece.to = split;
    }
    const auto leaf = static_cast<std::size_t>(~piece.node);
    const bool solid = leaf >= bsp.leafs.size() || bsp.leafs[leaf].contents == formats::kContentsSolid;
    if (first) {
      result.start_solid = result.all_solid = solid;
    } else if (solid && !was_solid) {
      result.hit = true;
      result.fraction = piece.from;
      result.normal = piece.normal;
      return result;
    }
    if (!solid) result.all_solid = false;
    first = false;
    was_solid = solid;
  }
  return result;
}

}  // namespace fb::world
