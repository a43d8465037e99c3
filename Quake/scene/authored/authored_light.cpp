#include "scene/authored/authored_light.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "scene/authored/closed_doors.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

constexpr std::size_t kPoints = 4000, kLeastPoints = 16;
constexpr std::size_t kMostProducts = 3'000'000;             // points times emitters
constexpr std::size_t kMostRays = 12'000'000;                // points times lamps
constexpr std::size_t kMostRaysOfMany = 6'000'000;           // the same for the gain field
constexpr double kPointArea = 600.0, kMostPoints = 32000.0;  // units^2 to a point of it
constexpr int kReflections = 2;                              // as r_bounces has it
constexpr float kLeastBaked = 0.004f;                        // as light: below it all luxels are dark

std::size_t many_points(const LitMap& map) {
  double area = 0;
  const formats::BspModel& world = map.bsp.models.front();
  for (std::uint32_t f = 0; f < world.face_count; ++f)
    area += world::face_area(map.bsp, map.bsp.faces[world.first_face + f]);
  return static_cast<std::size_t>(std::clamp(area / kPointArea, static_cast<double>(kPoints), kMostPoints));
}

// What no luxel of any face has the style of has lit nothing.
void put_out_unbaked_styles(const Lightmaps& lightmaps, const MapEmitters& emitters, LightFit& fit) {
  std::array<bool, 256> baked{};
  for (const Lightmaps::Face& face : lightmaps.faces())
    for (const std::uint8_t style : face.styles) baked[style] = true;
  for (std::size_t e = 0; e < emitters.all.size(); ++e) {
    const Emitter& emitter = emitters.all[e];
    const bool has_style = emitter.kind == EmitterKind::kLamp || emitter.kind == EmitterKind::kTexture;
    if (has_style && !baked[static_cast<std::uint8_t>(emitter.style)]) fit.factors[e] = vec3(0.0f);
  }
}

std::vector<vec3> fitted_light(const LightTransport& transport, const LightFit& fit) {
  std::vector<vec3> light(transport.points, vec3(0.0f));
  for (std::size_t i = 0; i < transport.points; ++i)
    for (std::size_t e = 0; e < transport.emitters; ++e)
      for (std::size_t c = 0; c < 3; ++c)
        light[i][static_cast<int>(c)] +=
            transport.light[c][i * transport.emitters + e] * fit.factors[e][static_cast<int>(c)];
  return light;
}

}  // namespace

std::optional<AuthoredLight> find_authored_light(const LitMap& map, const Lightmaps& lightmaps) {
  if (lightmaps.empty() || map.bsp.models.empty()) return std::nullopt;
  const auto start = std::chrono::steady_clock::now();
  AuthoredLight out;
  out.emitters = find_emitters(map);
  const std::size_t lamps = std::max<std::size_t>(map.lamps.size(), 1);
  const std::size_t count =
      std::min({kPoints, kMostProducts / std::max<std::size_t>(out.emitters.all.size(), 1), kMostRays / lamps});
  std::vector<LuxelPoint> points = choose_luxels(map, lightmaps, count);
  give_back_darkness(map, points);
  const bool lit = std::ranges::any_of(points, [](const LuxelPoint& p) {
    return std::ranges::any_of(p.baked, [](const vec3& l) { return std::max({l.x, l.y, l.z}) > kLeastBaked; });
  });
  if (points.size() < kLeastPoints || !lit) return std::nullopt;
  out.points = points.size();
  LightTransport transport = transport_light(map, out.emitters, points, kReflections);
  if (map.stopped()) return std::nullopt;
  out.fit = fit_light(out.emitters.all, points, transport);
  if (std::ranges::any_of(out.emitters.all, [](const Emitter& e) { return e.fall_scale > 0.0f; })) {
    // Tools put a few points of light on a large face: whether it is nearer to their law or to the square's, luxels
    // say.
    MapEmitters by_square = out.emitters;
    for (Emitter& e : by_square.all) e.fall_scale = 0.0f;
    LightTransport other = with_other_falls(map, by_square, points, transport, kReflections);
    if (map.stopped()) return std::nullopt;
    LightFit other_fit = fit_light(by_square.all, points, other);
    if (other_fit.stops_after < out.fit.stops_after) {
      out.emitters = std::move(by_square);
      transport = std::move(other);
      out.fit = std::move(other_fit);
    }
  }
  put_out_unbaked_styles(lightmaps, out.emitters, out.fit);
  out.lit_through = doors_lit_through(map, out.emitters, out.fit, points, transport);
  const std::vector<LuxelPoint> many =
      choose_luxels(map, lightmaps, std::min(many_points(map), kMostRaysOfMany / lamps));
  out.gains = make_gain_field(
      map.bsp, many, light_at(map, out.emitters, out.fit.factors, many, points, fitted_light(transport, out.fit)));
  if (map.stopped()) return std::nullopt;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

AuthoredTask::AuthoredTask(LitMap map, const Lightmaps& lightmaps) {
  map.stop = &stop_;
  result_ = std::async(std::launch::async,
                       [map = std::move(map), &lightmaps] { return find_authored_light(map, lightmaps); });
}

AuthoredTask::~AuthoredTask() { stop_ = true; }

bool AuthoredTask::ready() const { return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

std::optional<AuthoredLight> AuthoredTask::take() { return result_.get(); }

}  // namespace fb::scene
