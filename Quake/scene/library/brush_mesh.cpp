#include "scene/library/brush_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "scene/library/coincident_faces.h"
#include "scene/library/surface_names.h"
#include "scene/shapes.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

constexpr std::size_t kMaxSearchedCorners = 64;  // compilers' faces have fewer; a damaged file's may have 100,000
constexpr float kMaxRepeats = 1e7f;              // texture axes beyond that come from a damaged file
constexpr float kMinTriangleArea = 1e-4f;        // units^2; less is a sliver between collinear corners

vec3 triangle_cross(const vec3& a, const vec3& b, const vec3& c) { return glm::cross(b - a, c - a); }

// The corner from which a fan over a convex polygon has the largest smallest triangle. Compilers put corners on
// straight edges (T junctions), and a fan from the wrong corner is all slivers.
std::size_t best_fan_start(const std::vector<vec3>& polygon) {
  const std::size_t n = polygon.size();
  if (n > kMaxSearchedCorners) return 0;
  std::size_t best = 0;
  float best_area = -1.0f;
  for (std::size_t start = 0; start < n; ++start) {
    float smallest = std::numeric_limits<float>::max();
    for (std::size_t k = 1; k + 1 < n && smallest > best_area; ++k) {
      const vec3 cross = triangle_cross(polygon[start], polygon[(start + k) % n], polygon[(start + k + 1) % n]);
      smallest = std::min(smallest, glm::length(cross));
    }
    if (smallest > best_area * 1.001f) {
      best = start;
      best_area = smallest;
    }
  }
  return best;
}

class BrushMeshBuilder {
 public:
  BrushMeshBuilder(const formats::Bsp& bsp, std::uint32_t model, MapMaterials& materials)
      : bsp_(bsp), model_(model), materials_(materials) {}

  void add_face(std::uint32_t number) {
    const formats::BspFace& face = bsp_.faces[number];
    if (face.surfedge_count < 3) return;
    const formats::BspTexInfo& texinfo = bsp_.texinfos[face.texinfo];
    const formats::BspTexture* texture =
        texinfo.texture < bsp_.textures.size() ? &bsp_.textures[texinfo.texture] : nullptr;
    if (texture != nullptr && is_tool_texture(texture->name)) return;

    if (skies_are_cut_ && texture != nullptr && is_sky_texture(texture->name)) {
      for (auto [piece, end] = skies_.equal_range(number); piece != end; ++piece)
        add_fan(piece->second, texinfo, texture, number);
      return;
    }
    std::vector<vec3> polygon = polygon_of(face);
    if (texture != nullptr && liquid_kind(texture->name) != LiquidKind::kNone)
      liquids_.push_back({face.texinfo, texinfo.texture, face.plane, face.back_side, std::move(polygon), number});
    else
      add_fan(polygon, texinfo, texture, number);
  }

  // Before any face is added: where skies have two sides in one plane, what is left of them.
  void find_skies(std::uint32_t first, std::uint32_t count) {
    std::vector<MapFace> faces;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const formats::BspFace& face = bsp_.faces[i];
      const std::uint32_t texture = bsp_.texinfos[face.texinfo].texture;
      if (face.surfedge_count < 3 || texture >= bsp_.textures.size() || !is_sky_texture(bsp_.textures[texture].name))
        continue;
      faces.push_back({face.texinfo, texture, face.plane, face.back_side, polygon_of(face), i});
    }
    const double before = area_of(faces);
    std::vector<MapFace> left = without_coincident(std::move(faces));
    skies_are_cut_ = area_of(left) < 0.9999 * before;
    if (!skies_are_cut_) return;  // faces stay in the map's order
    for (MapFace& face : left) skies_.emplace(face.number, std::move(face.polygon));
  }

  Mesh take(std::string name) {
    for (const MapFace& face : without_coincident(std::move(liquids_)))
      add_fan(face.polygon, bsp_.texinfos[face.texinfo], &bsp_.textures[face.texture], face.number,
              liquid_in_front(face));
    mesh_.name = std::move(name);
    finish_mesh(mesh_);
    return std::move(mesh_);
  }

  // Which of a face's two sides is kept says nothing of where the liquid is; the tree of nodes does.
  bool liquid_in_front(const MapFace& face) const {
    vec3 middle(0.0f);
    for (const vec3& p : face.polygon) middle += p / static_cast<float>(face.polygon.size());
    const vec3 front = bsp_.planes[face.plane].normal * (face.back_side ? -1.0f : 1.0f);
    const auto wet = [&](float side) {
      const std::int32_t contents = world::point_contents(bsp_, middle + front * side, model_);
      return contents == formats::kContentsWater || contents == formats::kContentsSlime ||
             (contents <= formats::kContentsCurrent0 && contents >= formats::kContentsCurrentDown);
    };
    const bool before = wet(1.0f), behind = wet(-1.0f);
    return before != behind ? before : front.z < -0.5f;  // where both or neither is, it is below
  }

 private:
  // Counter-clockwise as seen from the front; Quake's faces run the other way.
  std::vector<vec3> polygon_of(const formats::BspFace& face) const {
    std::vector<vec3> polygon;
    vec3 normal(0.0f);
    for (std::uint32_t k = 0; k < face.surfedge_count; ++k) polygon.push_back(bsp_.face_vertex(face, k));
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      normal += triangle_cross(polygon[0], polygon[k], polygon[k + 1]);
    const vec3 front = bsp_.planes[face.plane].normal * (face.back_side ? -1.0f : 1.0f);
    if (glm::dot(normal, front) < 0.0f) std::ranges::reverse(polygon);
    return polygon;
  }

  static double area_of(const std::vector<MapFace>& faces) {
    double area = 0.0;
    for (const MapFace& face : faces) area += polygon_area(face.polygon);
    return area;
  }

  void add_fan(const std::vector<vec3>& polygon, const formats::BspTexInfo& texinfo, const formats::BspTexture* texture,
               std::uint32_t number, bool liquid_in_front = false) {
    const std::size_t n = polygon.size(), start = best_fan_start(polygon);
    const vec2 size = units_of(texinfo, texture);
    const auto uv_at = [&](const vec3& p) {
      const vec2 uv = vec2(glm::dot(vec3(texinfo.axes[0]), p) + texinfo.axes[0].w,
                           glm::dot(vec3(texinfo.axes[1]), p) + texinfo.axes[1].w) /
                      size;
      const auto sane = [](float x) { return std::fabs(x) < kMaxRepeats ? x : 0.0f; };
      return vec2(sane(uv.x), sane(uv.y));
    };
    // Large repeats cost precision: move the face's coordinates near zero by whole repeats.
    const vec2 shift = glm::floor(uv_at(polygon[start]));
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < n; ++k) corners.push_back(vertex(polygon[(start + k) % n]));
    const std::uint32_t material = materials_.material(texinfo.texture);
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const std::array<std::size_t, 3> ids{start, (start + k) % n, (start + k + 1) % n};
      const vec3 cross = triangle_cross(polygon[ids[0]], polygon[ids[1]], polygon[ids[2]]);
      if (glm::length(cross) < 2.0f * kMinTriangleArea) continue;
      MeshTriangle triangle{{corners[0], corners[k], corners[k + 1]}, material, {}, liquid_in_front ? 1u : 0u, number};
      for (std::size_t c = 0; c < 3; ++c) triangle.uv[c] = uv_at(polygon[ids[c]]) - shift;
      mesh_.triangles.push_back(triangle);
    }
  }

  // How many units of the texture axes one repeat covers.
  vec2 units_of(const formats::BspTexInfo& texinfo, const formats::BspTexture* texture) const {
    if (texture == nullptr) return vec2(16.0f);
    const float texel = texture->shift > 0 ? 2.0f * static_cast<float>(texture->shift) : 1.0f;
    // QuakeSpasm's liquids repeat every 64 units; Quake 64's have any size, others 64 texels.
    if (bsp_.version == formats::BspVersion::kQuake64 && liquid_kind(texture->name) != LiquidKind::kNone)
      return vec2((texinfo.flags & formats::kTexSpecial) != 0 ? 64.0f : 64.0f * texel);
    return texel * vec2(std::max(texture->width, 1), std::max(texture->height, 1));
  }

  std::uint32_t vertex(const vec3& p) {
    const auto [at, added] = vertices_.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (added) mesh_.positions.push_back(p);
    return at->second;
  }

  const formats::Bsp& bsp_;
  std::uint32_t model_;
  MapMaterials& materials_;
  Mesh mesh_;
  std::map<std::array<float, 3>, std::uint32_t> vertices_;
  std::vector<MapFace> liquids_;
  std::multimap<std::uint32_t, std::vector<vec3>> skies_;  // what is left of a map's face, by its number
  bool skies_are_cut_ = false;
};

}  // namespace

Mesh make_brush_mesh(const formats::Bsp& bsp, std::uint32_t model, MapMaterials& materials, std::string name) {
  BrushMeshBuilder builder(bsp, model, materials);
  const formats::BspModel& m = bsp.models[model];
  builder.find_skies(m.first_face, m.face_count);
  for (std::uint32_t i = 0; i < m.face_count; ++i) builder.add_face(m.first_face + i);
  return builder.take(std::move(name));
}

}  // namespace fb::scene
