#include "scene/authored/light_transport.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/parallel.h"
#include "base/rng.h"
#include "scene/authored/map_rays.h"
#include "scene/library/surface_names.h"
#include "shared/spot.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

constexpr int kRays = 32;      // from each point, over the hemisphere
constexpr int kSkyRays = 64;   // the same where there is a sky, whose light they find
constexpr int kFewRays = 12;   // the same where a point is one of many
constexpr int kPatchRays = 4;  // to the patches of one texture
constexpr float kRayLength = 32768.0f;
constexpr float kFarAway = 2.0f;      // radii from which a cluster of patches is one
constexpr float kLeastLight = 2e-4f;  // of one emitter that is asked for: less is dark on any display
constexpr std::size_t kPiece = 64;    // points that a thread takes at a time

// Uniform over the face.
vec3 point_of(const formats::Bsp& bsp, const formats::BspFace& face, Rng& rng) {
  std::vector<float> up_to;  // areas of the fan's triangles
  float area = 0.0f;
  for (std::uint32_t k = 1; k + 1 < face.surfedge_count; ++k) {
    const vec3& a = bsp.face_vertex(face, 0);
    area += 0.5f * glm::length(glm::cross(bsp.face_vertex(face, k) - a, bsp.face_vertex(face, k + 1) - a));
    up_to.push_back(area);
  }
  const auto at = std::ranges::lower_bound(up_to, rng.uniform() * area);
  const auto k = 1 + static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(at - up_to.begin(), std::ssize(up_to) - 1));
  float u = rng.uniform(), v = rng.uniform();
  if (u + v > 1.0f) {
    u = 1.0f - u;
    v = 1.0f - v;
  }
  const vec3& a = bsp.face_vertex(face, 0);
  return a + u * (bsp.face_vertex(face, k) - a) + v * (bsp.face_vertex(face, k + 1) - a);
}

// The k-th of `count` directions by Lambert's law: points of the unit sphere about the normal's end, along a spiral
// (Fibonacci's) turned by `turn`, so that they lie evenly.
vec3 cosine_direction(const vec3& normal, int k, int count, const vec2& turn) {
  constexpr float kGolden = 0.61803399f;
  const float at = static_cast<float>(k), whole = at * kGolden + turn.y;
  const float z = 1.0f - 2.0f * (at + turn.x) / static_cast<float>(count),
              angle = 2.0f * kPi * (whole - std::floor(whole));
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const vec3 sum = normal + vec3(r * std::cos(angle), r * std::sin(angle), z);
  const float length = glm::length(sum);
  return length > 1e-3f ? sum / length : normal;
}

// Points by place, so that what a ray meets finds one near it that faces the same way.
class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<LuxelPoint>& points) : points_(points) {
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      by_face_[points[i].face].push_back(i);
      by_cell_[cell(points[i].position, points[i].normal)].push_back(i);
    }
  }
  // kNone where there is none near.
  std::uint32_t at(std::uint32_t face, const vec3& position, const vec3& normal) const {
    const auto own = by_face_.find(face);
    if (own != by_face_.end()) return nearest(own->second, position);
    const auto around = by_cell_.find(cell(position, normal));
    return around != by_cell_.end() ? nearest(around->second, position) : kNone;
  }

 private:
  using Cell = std::tuple<int, int, int, int>;
  static Cell cell(const vec3& p, const vec3& n) {
    constexpr float kSide = 192.0f;
    const vec3 a = glm::abs(n);
    const int axis = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    return {static_cast<int>(std::floor(p.x / kSide)), static_cast<int>(std::floor(p.y / kSide)),
            static_cast<int>(std::floor(p.z / kSide)), axis * 2 + (n[axis] > 0.0f ? 1 : 0)};
  }
  std::uint32_t nearest(const std::vector<std::uint32_t>& among, const vec3& position) const {
    return *std::ranges::min_element(among, {}, [&](std::uint32_t i) {
      const vec3 way = points_[i].position - position;
      return glm::dot(way, way);
    });
  }
  const std::vector<LuxelPoint>& points_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_face_;
  std::map<Cell, std::vector<std::uint32_t>> by_cell_;
};

// work(i), concurrently, until the map's work is to stop.
template <typename Work>
void for_pieces(const LitMap& map, std::size_t count, const Work& work) {
  parallel_for((count + kPiece - 1) / kPiece, 1, [&](std::size_t piece) {
    if (map.stopped()) return;
    for (std::size_t i = piece * kPiece; i < std::min(count, (piece + 1) * kPiece); ++i) work(i);
  });
}

// Light at points, straight and by what reflects it: `mirrors`, points themselves.
class Transport {
 public:
  Transport(const LitMap& map, const MapEmitters& emitters, const std::vector<LuxelPoint>& points,
            const std::vector<LuxelPoint>& mirrors, int rays)
      : map_(map),
        emitters_(emitters),
        points_(points),
        ray_count_(rays),
        rays_(map.bsp),
        nearest_(mirrors),
        met_(points.size()),
        lost_(points.size(), 0) {
    for (const EntityLight& lamp : map.lamps) lamp_leafs_.push_back(world::point_in_leaf(map.bsp, lamp.position));
    for (const EmitterPatch& patch : emitters.patches)
      patch_leafs_.push_back(world::point_in_leaf(map.bsp, patch.middle));
    for (std::uint32_t i = 0; i < emitters.clusters.size(); ++i) {
      const std::uint32_t emitter = emitters.clusters[i].emitter;
      if (textures_.empty() || textures_.back().emitter != emitter) textures_.push_back({emitter, i, i});
      textures_.back().end = i + 1;
    }
    for (std::size_t e = 0; e < emitters.all.size(); ++e)
      if (emitters.all[e].kind == EmitterKind::kSky) sky_ = e;
  }

  // add(point, emitter, light) for what comes straight; concurrently, but of one point at a time.
  template <typename Add>
  void straight(const Add& add) {
    each_point([&](std::size_t i) { light_straight(i, add); });
  }
  // The same of what textures give, to the bit.
  template <typename Add>
  void straight_of_textures(const Add& add) {
    each_point([&](std::size_t i) {
      Rng rng(i);
      light_by_patches(i, leafs_seen_by(i), rng, add);
    });
  }
  template <typename Work>
  void each_point(const Work& work) const {
    for_pieces(map_, points_.size(), work);
  }
  // The mirrors that a point's rays met, each by a share 1 / rays of its reflected light.
  const std::vector<std::uint32_t>& met(std::size_t point) const { return met_[point]; }
  bool is_outside(std::size_t point) const { return lost_[point] > ray_count_ / 8; }

 private:
  std::vector<bool> leafs_seen_by(std::size_t i) const {
    return world::leaf_visibility(map_.bsp, world::point_in_leaf(map_.bsp, points_[i].position));
  }
  template <typename Add>
  void light_straight(std::size_t i, const Add& add) {
    const LuxelPoint& p = points_[i];
    Rng rng(i);
    const std::vector<bool> seen = leafs_seen_by(i);
    for (std::size_t e = 0; e < emitters_.all.size(); ++e) {
      const Emitter& emitter = emitters_.all[e];
      for (const std::uint32_t lamp : emitter.lamps) add(i, e, lamp_light(p, lamp, seen));
      if (emitter.kind == EmitterKind::kSun) add(i, e, sun_light(p, emitter));
      if (emitter.kind == EmitterKind::kAmbient) add(i, e, emitter.power);
    }
    light_by_patches(i, seen, rng, add);
    const vec2 turn(rng.uniform(), rng.uniform());
    for (int k = 0; k < ray_count_; ++k) {
      const vec3 direction = cosine_direction(p.normal, k, ray_count_, turn);
      const auto hit = rays_.first_face(p.position, p.position + direction * kRayLength);
      if (!hit) {
        ++lost_[i];
        continue;
      }
      if (rays_.is_sky(hit->face)) {
        add(i, sky_, emitters_.all[sky_].power / static_cast<float>(ray_count_));
        continue;
      }
      const std::uint32_t at = nearest_.at(hit->face, hit->point, rays_.normal(hit->face));
      if (at != kNone) met_[i].push_back(at);
    }
  }

  vec3 lamp_light(const LuxelPoint& p, std::uint32_t index, const std::vector<bool>& seen) const {
    const EntityLight& lamp = map_.lamps[index];
    const vec3 light = unshadowed_light(lamp, p);
    if (light == vec3(0.0f) || !sees(seen, lamp_leafs_[index]) || !rays_.is_clear(p.position, lamp.position))
      return vec3(0.0f);
    return light;
  }

  static bool sees(const std::vector<bool>& seen, std::uint32_t leaf) { return leaf >= seen.size() || seen[leaf]; }

  vec3 sun_light(const LuxelPoint& p, const Emitter& emitter) const {
    const vec3& direction = map_.suns[emitter.index].direction;
    const float cosine = glm::dot(direction, p.normal);
    if (cosine <= 0.0f) return vec3(0.0f);
    const auto hit = rays_.first_face(p.position, p.position + direction * kRayLength);
    return hit && rays_.is_sky(hit->face) ? emitter.power * cosine : vec3(0.0f);
  }

  // What an area gives a point, of radiance 1, if nothing stands between.
  static float light_of_area(const LuxelPoint& p, const vec3& middle, const vec3& normal, float area,
                             float fall_scale) {
    const vec3 way = middle - p.position;
    const float here = glm::dot(way, p.normal), there = -glm::dot(way, normal), square = glm::dot(way, way);
    if (here <= 0.0f || there <= 0.0f) return 0.0f;
    const float fall =
        fall_scale > 0.0f ? shared::fall_share(shared::kFallLinear, std::sqrt(square) * fall_scale) : 1.0f;
    return area * here * there * fall / (square * (kPi * square + area));
  }

  struct Part {  // of a texture: patches whose light goes up to this, of all so far
    float up_to;
    std::uint32_t first, count;
  };
  // A cluster's patches one by one, or from afar as one.
  float add_parts(const LuxelPoint& p, const PatchCluster& cluster, float sum, std::vector<Part>& parts) const {
    const float scale = emitters_.all[cluster.emitter].fall_scale;
    const vec3 way = cluster.middle - p.position;
    if (glm::dot(way, cluster.normal) >= 0.0f || glm::dot(way, p.normal) <= -cluster.radius) return sum;
    if (glm::dot(way, way) > kFarAway * kFarAway * cluster.radius * cluster.radius) {
      const float light = light_of_area(p, cluster.middle, cluster.normal, cluster.area, scale);
      if (light > 0.0f) parts.push_back({sum += light, cluster.first, cluster.end - cluster.first});
      return sum;
    }
    for (std::uint32_t k = cluster.first; k < cluster.end; ++k) {
      const EmitterPatch& patch = emitters_.patches[k];
      const float light = light_of_area(p, patch.middle, patch.normal, patch.area, scale);
      if (light > 0.0f) parts.push_back({sum += light, k, 1});
    }
    return sum;
  }

  // The light of all of a texture's patches, times the share of it that some of them, chosen by their light, show
  // unhindered.
  template <typename Add>
  void light_by_patches(std::size_t i, const std::vector<bool>& seen, Rng& rng, const Add& add) const {
    const LuxelPoint& p = points_[i];
    std::vector<Part> parts;
    for (const Range& range : textures_) {
      parts.clear();
      float sum = 0.0f;
      for (std::uint32_t c = range.first; c < range.end; ++c) sum = add_parts(p, emitters_.clusters[c], sum, parts);
      const vec3 light = emitters_.all[range.emitter].power * sum;
      if (std::max({light.x, light.y, light.z}) < kLeastLight) continue;
      int clear_rays = 0;
      for (int k = 0; k < kPatchRays; ++k) {
        const float at = (static_cast<float>(k) + rng.uniform()) / static_cast<float>(kPatchRays) * sum;
        const auto chosen = std::ranges::upper_bound(parts, at, {}, &Part::up_to);
        const Part& part = chosen == parts.end() ? parts.back() : *chosen;
        const float within = rng.uniform() * static_cast<float>(part.count);
        const std::size_t patch = part.first + std::min(static_cast<std::uint32_t>(within), part.count - 1);
        if (sees(seen, patch_leafs_[patch]) && rays_.is_clear(p.position, emitters_.patches[patch].middle))
          ++clear_rays;
      }
      add(i, range.emitter, light * (static_cast<float>(clear_rays) / static_cast<float>(kPatchRays)));
    }
  }

  struct Range {  // clusters of a texture
    std::uint32_t emitter, first, end;
  };
  const LitMap& map_;
  const MapEmitters& emitters_;
  const std::vector<LuxelPoint>& points_;
  int ray_count_;
  MapRays rays_;
  NearestPoint nearest_;
  std::vector<Range> textures_;
  std::vector<std::uint32_t> lamp_leafs_, patch_leafs_;
  std::vector<std::vector<std::uint32_t>> met_;
  std::vector<int> lost_;  // rays that left the map
  std::size_t sky_ = 0;
};

}  // namespace

vec3 unshadowed_light(const EntityLight& lamp, const LuxelPoint& p) {
  const vec3 way = lamp.position - p.position;
  const float cosine_times = glm::dot(way, p.normal), square = std::max(glm::dot(way, way), lamp.radius * lamp.radius);
  if (cosine_times <= 0.0f) return vec3(0.0f);
  const float distance = std::sqrt(square);
  const float spot = lamp.axis == vec3(0.0f) ? 1.0f
                                             : shared::spot_share(-glm::dot(way, lamp.axis) / distance,
                                                                  lamp.least_cosine, lamp.full_cosine);
  const float fall = shared::fall_share(lamp.fall, distance * lamp.fall_scale);
  const vec3 light = lamp.power_color * (lamp.radius * lamp.radius * cosine_times / (square * distance) * spot * fall);
  return std::max({light.x, light.y, light.z}) < kLeastLight ? vec3(0.0f) : light;
}

std::vector<LuxelPoint> choose_luxels(const LitMap& map, const Lightmaps& lightmaps, std::size_t count) {
  std::vector<LuxelPoint> points;
  const formats::BspModel& world = map.bsp.models.front();
  std::vector<std::uint32_t> faces;
  std::vector<double> up_to;
  double area = 0;
  for (std::uint32_t f = world.first_face; f < world.first_face + world.face_count; ++f) {
    const double a = world::face_area(map.bsp, map.bsp.faces[f]);
    const std::uint32_t texture = map.bsp.texinfos[map.bsp.faces[f].texinfo].texture;
    const std::string_view name =
        texture < map.bsp.textures.size() ? map.bsp.textures[texture].name : std::string_view();
    if (!lightmaps.has(f, 0) || is_sky_texture(name) || liquid_kind(name) != LiquidKind::kNone || !(a > 1.0)) continue;
    faces.push_back(f);
    up_to.push_back(area += a);
  }
  if (faces.empty()) return points;
  const MapRays rays(map.bsp);
  Rng rng(53);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + static_cast<double>(rng.uniform())) / static_cast<double>(count) * area;
    const auto k = std::min<std::ptrdiff_t>(std::ranges::upper_bound(up_to, at) - up_to.begin(), std::ssize(faces) - 1);
    LuxelPoint p{};
    p.face = faces[static_cast<std::size_t>(k)];
    const formats::BspFace& face = map.bsp.faces[p.face];
    const vec3 on_face = point_of(map.bsp, face, rng);
    p.normal = rays.normal(p.face);
    p.position = on_face + p.normal;
    const std::int32_t contents = world::point_contents(map.bsp, p.position);
    if (contents != formats::kContentsEmpty && contents != formats::kContentsWater) continue;
    const LitSurface* surface = map.surface_of(face);
    if (surface == nullptr) continue;
    p.reflectance = surface->reflectance;
    for (std::size_t s = 0; s < 4; ++s) {
      p.styles[s] = lightmaps.has(p.face, s) ? lightmaps.style(p.face, s) : Lightmaps::kNoStyle;
      p.baked[s] = light_of_display(lightmaps.value(p.face, s, on_face), p.reflectance);
    }
    points.push_back(p);
  }
  return points;
}

void give_back_darkness(const LitMap& map, std::vector<LuxelPoint>& points) {
  if (map.darkening.empty()) return;
  const MapRays rays(map.bsp);
  for (const EntityLight& lamp : map.darkening)
    for (LuxelPoint& p : points)
      for (std::size_t k = 0; k < p.styles.size(); ++k) {
        if (p.styles[k] != lamp.style) continue;
        const vec3 taken = unshadowed_light(lamp, p);
        if (taken != vec3(0.0f) && rays.is_clear(p.position, lamp.position)) p.baked[k] += taken;
      }
}

namespace {

// Reflects what comes straight so many times, between the points.
void reflect(const LitMap& map, const std::vector<LuxelPoint>& points, int reflections, LightTransport& transport) {
  const std::size_t n = transport.emitters;
  transport.light = transport.straight;
  for (int k = 0; k < reflections; ++k) {
    const auto before = transport.light;
    for_pieces(map, points.size(), [&](std::size_t i) {
      for (std::size_t c = 0; c < 3; ++c) {
        float* const to = &transport.light[c][i * n];
        std::copy_n(&transport.straight[c][i * n], n, to);
        for (const std::uint32_t j : transport.met[i]) {
          const float share = points[j].reflectance[static_cast<int>(c)] / static_cast<float>(transport.rays);
          for (std::size_t e = 0; e < n; ++e) to[e] += share * before[c][j * n + e];
        }
        // An even light, the last, is not reflected: the renderer adds it once.
        to[n - 1] = transport.straight[c][i * n + n - 1];
      }
    });
  }
}

bool shows_sky(const formats::Bsp& bsp) {
  return std::ranges::any_of(bsp.faces, [&](const formats::BspFace& face) {
    const std::uint32_t texture = bsp.texinfos[face.texinfo].texture;
    return texture < bsp.textures.size() && is_sky_texture(bsp.textures[texture].name);
  });
}

// Adds to what comes straight.
auto adder_of(LightTransport& transport) {
  return [&transport](std::size_t i, std::size_t e, const vec3& light) {
    for (std::size_t c = 0; c < 3; ++c) transport.straight[c][i * transport.emitters + e] += light[static_cast<int>(c)];
  };
}

}  // namespace

LightTransport transport_light(const LitMap& map, const MapEmitters& emitters, const std::vector<LuxelPoint>& points,
                               int reflections) {
  LightTransport out;
  out.points = points.size();
  out.emitters = emitters.all.size();
  for (auto& channel : out.straight) channel.assign(out.points * out.emitters, 0.0f);
  out.rays = shows_sky(map.bsp) ? kSkyRays : kRays;
  Transport transport(map, emitters, points, points, out.rays);
  transport.straight(adder_of(out));
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.met.push_back(transport.met(i));
    out.outside.push_back(transport.is_outside(i) ? 1 : 0);
  }
  reflect(map, points, reflections, out);
  return out;
}

LightTransport with_other_falls(const LitMap& map, const MapEmitters& emitters, const std::vector<LuxelPoint>& points,
                                const LightTransport& former, int reflections) {
  LightTransport out = former;
  for (std::size_t e = 0; e < out.emitters; ++e)
    if (emitters.all[e].kind == EmitterKind::kTexture)
      for (auto& channel : out.straight)
        for (std::size_t i = 0; i < out.points; ++i) channel[i * out.emitters + e] = 0.0f;
  Transport transport(map, emitters, points, points, 0);
  transport.straight_of_textures(adder_of(out));
  reflect(map, points, reflections, out);
  return out;
}

std::vector<vec3> light_at(const LitMap& map, const MapEmitters& emitters, const std::vector<vec3>& factors,
                           const std::vector<LuxelPoint>& points, const std::vector<LuxelPoint>& mirrors,
                           const std::vector<vec3>& mirrors_light) {
  std::vector<vec3> light(points.size(), vec3(0.0f));
  Transport transport(map, emitters, points, mirrors, kFewRays);
  transport.straight([&](std::size_t i, std::size_t e, const vec3& straight) { light[i] += straight * factors[e]; });
  transport.each_point([&](std::size_t i) {
    for (const std::uint32_t j : transport.met(i))
      light[i] += mirrors[j].reflectance * mirrors_light[j] / static_cast<float>(kFewRays);
    if (transport.is_outside(i)) light[i] = vec3(-1.0f);
  });
  return light;
}

}  // namespace fb::scene
