#include "scene/authored/closed_doors.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/parallel.h"
#include "scene/authored/map_rays.h"
#include "scene/library/asset_builder.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

constexpr float kMostTaken = 0.5f;          // of a place's light that a closed door may take: a stop
constexpr float kLeastOfPlace = 0.05f;      // of a place's light, of one emitter: less decides nothing
constexpr float kLeastBakedLight = 0.004f;  // baked, as light: places below are dark with or without it
constexpr double kLeastDarkArea = 16384.0;  // units^2 of places that it takes so much from
constexpr std::size_t kLeastPlaces = 3;     // likewise
constexpr float kToSky = 32768.0f;
constexpr std::size_t kPointsAtOnce = 64;  // points that a thread takes at a time

class Doors {
 public:
  Doors(const LitMap& map, const MapEmitters& emitters, const LightFit& fit, const LightTransport& transport)
      : map_(map), emitters_(emitters), fit_(fit), transport_(transport), rays_(map.bsp) {}

  // Those that take too much of what the point has.
  std::vector<std::uint32_t> in_the_way(std::size_t i, const LuxelPoint& p) const {
    std::vector<std::uint32_t> found;
    float all = 0.0f, baked = 0.0f;
    for (std::size_t e = 0; e < emitters_.all.size(); ++e) all += luminance(light_of(i, e));
    for (std::size_t k = 0; k < p.baked.size(); ++k)
      if (p.styles[k] != Lightmaps::kNoStyle) baked += luminance(p.baked[k]);
    if (transport_.outside[i] != 0 || baked < kLeastBakedLight || !(all > 0.0f)) return found;
    std::map<std::uint32_t, float> taken;
    for (std::size_t e = 0; e < emitters_.all.size(); ++e) {
      const Emitter& emitter = emitters_.all[e];
      if (luminance(light_of(i, e)) < kLeastOfPlace * all) continue;
      for (const std::uint32_t index : emitter.lamps) {
        const EntityLight& lamp = map_.lamps[index];
        const float light = luminance(unshadowed_light(lamp, p) * fit_.factors[e]);
        if (light > 0.0f && rays_.is_clear(p.position, lamp.position)) take(p.position, lamp.position, light, taken);
      }
      if (emitter.kind != EmitterKind::kSun) continue;
      const vec3& direction = map_.suns[emitter.index].direction;
      const vec3 end = p.position + direction * kToSky;
      const auto hit = rays_.first_face(p.position, end);
      const float light = luminance(emitter.power * fit_.factors[e]) * glm::dot(direction, p.normal);
      if (light > 0.0f && hit && rays_.is_sky(hit->face)) take(p.position, hit->point, light, taken);
    }
    for (const auto& [door, light] : taken)
      if (light > kMostTaken * all) found.push_back(door);
    return found;
  }

 private:
  vec3 light_of(std::size_t i, std::size_t e) const {
    vec3 light(0.0f);
    for (std::size_t c = 0; c < 3; ++c)
      light[static_cast<int>(c)] =
          transport_.light[c][i * transport_.emitters + e] * fit_.factors[e][static_cast<int>(c)];
    return light;
  }
  void take(const vec3& from, const vec3& to, float light, std::map<std::uint32_t, float>& taken) const {
    for (const Submodel& door : map_.submodels)
      if (world::trace_line(map_.bsp, from - door.offset, to - door.offset, door.index).hit) taken[door.index] += light;
  }

  const LitMap& map_;
  const MapEmitters& emitters_;
  const LightFit& fit_;
  const LightTransport& transport_;
  MapRays rays_;
};

}  // namespace

std::vector<std::uint32_t> doors_lit_through(const LitMap& map, const MapEmitters& emitters, const LightFit& fit,
                                             const std::vector<LuxelPoint>& points, const LightTransport& transport) {
  if (map.submodels.empty() || points.empty()) return {};
  const Doors doors(map, emitters, fit, transport);
  std::vector<std::vector<std::uint32_t>> of_points(points.size());
  parallel_for((points.size() + kPointsAtOnce - 1) / kPointsAtOnce, 1, [&](std::size_t piece) {
    if (map.stopped()) return;
    for (std::size_t i = piece * kPointsAtOnce; i < std::min(points.size(), (piece + 1) * kPointsAtOnce); ++i)
      of_points[i] = doors.in_the_way(i, points[i]);
  });
  std::set<std::uint32_t> faces;
  for (const LuxelPoint& p : points) faces.insert(p.face);
  double area = 0;
  for (const std::uint32_t face : faces) area += world::face_area(map.bsp, map.bsp.faces[face]);
  const double of_one = area / static_cast<double>(points.size());
  std::map<std::uint32_t, std::size_t> places;
  for (const auto& found : of_points)
    for (const std::uint32_t door : found) ++places[door];
  std::vector<std::uint32_t> through;
  for (const auto& [door, count] : places)
    if (count >= kLeastPlaces && static_cast<double>(count) * of_one >= kLeastDarkArea) through.push_back(door);
  return through;
}

}  // namespace fb::scene
