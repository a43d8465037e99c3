#include "scene/authored/emitters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scene/library/asset_builder.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

constexpr float kPatchSide = 64.0f;     // units
constexpr float kClusterSide = 256.0f;  // likewise
constexpr std::size_t kMostPatches = 20000, kMostLampGroups = 384;
constexpr vec3 kLeastAmbient{1e-3f};  // what an even light that the map does not ask for begins with
constexpr vec3 kLeastSky{2e-2f};

// Triangles of the face, cut until they are small.
void add_patches(const formats::Bsp& bsp, const formats::BspFace& face, std::uint32_t emitter, float side,
                 std::vector<EmitterPatch>& patches) {
  const vec3 normal = bsp.planes[face.plane].normal * (face.back_side ? -1.0f : 1.0f);
  const auto cut = [&](const auto& self, const vec3& a, const vec3& b, const vec3& c, int depth) -> void {
    const float ab = glm::length(b - a), bc = glm::length(c - b), ca = glm::length(a - c);
    const float longest = std::max({ab, bc, ca});
    if (longest > 1.5f * side && depth < 12) {
      if (longest == ab) {
        self(self, a, (a + b) * 0.5f, c, depth + 1);
        self(self, (a + b) * 0.5f, b, c, depth + 1);
      } else if (longest == bc) {
        self(self, a, b, (b + c) * 0.5f, depth + 1);
        self(self, a, (b + c) * 0.5f, c, depth + 1);
      } else {
        self(self, a, b, (c + a) * 0.5f, depth + 1);
        self(self, (c + a) * 0.5f, b, c, depth + 1);
      }
      return;
    }
    const float area = 0.5f * glm::length(glm::cross(b - a, c - a));
    if (area > 1e-3f) patches.push_back({(a + b + c) / 3.0f + normal, normal, area, emitter});
  };
  for (std::uint32_t k = 1; k + 1 < face.surfedge_count; ++k)
    cut(cut, bsp.face_vertex(face, 0), bsp.face_vertex(face, k), bsp.face_vertex(face, k + 1), 0);
}

// Sorts patches by emitter, way and place, and makes clusters of those that have all three in common.
void make_clusters(MapEmitters& out) {
  const auto key = [](const EmitterPatch& p) {
    const auto whole = [](float x) { return static_cast<int>(std::floor(x)); };
    const vec3 cell = p.middle / kClusterSide, way = p.normal * 64.0f + 0.5f;
    return std::array{static_cast<int>(p.emitter),
                      whole(way.x),
                      whole(way.y),
                      whole(way.z),
                      whole(cell.x),
                      whole(cell.y),
                      whole(cell.z)};
  };
  std::ranges::stable_sort(out.patches, {}, key);
  for (std::uint32_t i = 0; i < out.patches.size();) {
    PatchCluster c{i, i, out.patches[i].emitter, vec3(0.0f), out.patches[i].normal, 0.0f, 0.0f};
    while (c.end < out.patches.size() && key(out.patches[c.end]) == key(out.patches[i])) {
      c.area += out.patches[c.end].area;
      c.middle += out.patches[c.end].middle * out.patches[c.end].area;
      ++c.end;
    }
    c.middle /= c.area;
    for (std::uint32_t k = c.first; k < c.end; ++k)
      c.radius = std::max(c.radius, glm::length(out.patches[k].middle - c.middle));
    out.clusters.push_back(c);
    i = c.end;
  }
}

// Groups are cubes of a side that grows until there are few enough.
void add_lamps(const std::vector<EntityLight>& lamps, std::vector<Emitter>& all) {
  std::vector<std::vector<std::uint32_t>> groups;
  for (float side = 1.0f;; side *= 1.5f) {
    std::map<std::array<int, 4>, std::vector<std::uint32_t>> cells;
    for (std::uint32_t i = 0; i < lamps.size(); ++i) {
      const vec3 at = glm::floor(lamps[i].position / side);
      cells[{static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z), lamps[i].style}].push_back(i);
    }
    if (cells.size() > kMostLampGroups) continue;
    for (auto& [cell, members] : cells) groups.push_back(std::move(members));
    break;
  }
  std::ranges::sort(groups);
  for (std::vector<std::uint32_t>& members : groups) {
    const EntityLight& first = lamps[members.front()];
    Emitter e;
    e.kind = EmitterKind::kLamp;
    e.style = first.style;
    e.name = fmt::format("light at {:.0f} {:.0f} {:.0f}", first.position.x, first.position.y, first.position.z);
    if (members.size() > 1) e.name += fmt::format(" and {} near it", members.size() - 1);
    for (const std::uint32_t i : members) e.power += lamps[i].power_color * (lamps[i].radius * lamps[i].radius);
    e.lamps = std::move(members);
    all.push_back(std::move(e));
  }
}

}  // namespace

std::vector<std::uint32_t> shown_faces(const LitMap& map) {
  std::vector<std::uint32_t> faces;
  const auto add = [&](const formats::BspModel& model) {
    for (std::uint32_t f = 0; f < model.face_count; ++f) faces.push_back(model.first_face + f);
  };
  add(map.bsp.models.front());
  for (const Submodel& submodel : map.submodels) add(map.bsp.models[submodel.index]);
  return faces;
}

MapEmitters find_emitters(const LitMap& map) {
  MapEmitters out;
  add_lamps(map.lamps, out.all);
  std::map<std::uint32_t, std::uint32_t> of_material;
  double area = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> glowing;  // face, emitter
  for (const std::uint32_t f : shown_faces(map)) {
    const formats::BspFace& face = map.bsp.faces[f];
    const LitSurface* surface = map.surface_of(face);
    if (surface == nullptr || face.surfedge_count < 3 || !(luminance(surface->radiance) > 1e-4f)) continue;
    const auto [at, added] = of_material.try_emplace(surface->material, static_cast<std::uint32_t>(out.all.size()));
    if (added)
      out.all.push_back({EmitterKind::kTexture,
                         "texture " + surface->name,
                         surface->material,
                         {},
                         surface->style,
                         surface->fall_scale,
                         surface->radiance,
                         vec3(0.0f)});
    glowing.emplace_back(f, at->second);
    area += world::face_area(map.bsp, face);
  }
  const float side = std::max(kPatchSide, static_cast<float>(std::sqrt(2.0 * area / kMostPatches)));
  for (const auto& [face, emitter] : glowing) add_patches(map.bsp, map.bsp.faces[face], emitter, side, out.patches);
  make_clusters(out);
  for (std::size_t i = 0; i < map.suns.size(); ++i)
    out.all.push_back({EmitterKind::kSun,
                       fmt::format("sun {}", i + 1),
                       static_cast<std::uint32_t>(i),
                       {},
                       0,
                       0.0f,
                       map.suns[i].irradiance / kPi,
                       vec3(0.0f)});
  out.all.push_back({EmitterKind::kSky, "sky", 0, {}, 0, 0.0f, glm::max(map.sky, kLeastSky), map.sky});
  out.all.push_back(
      {EmitterKind::kAmbient, "even light", 0, {}, 0, 0.0f, glm::max(map.ambient, kLeastAmbient), map.ambient});
  for (Emitter& e : out.all)
    if (e.kind != EmitterKind::kSky && e.kind != EmitterKind::kAmbient) e.own = e.power;
  return out;
}

}  // namespace fb::scene
