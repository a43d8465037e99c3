// How much light each emitter of a map brings to chosen points of its faces: straight, in shadow or not, and after
// reflections. The model that is fitted to baked light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/authored/emitters.h"
#include "scene/library/lightmaps.h"

namespace fb::scene {

// A point with baked light, one unit off its face.
struct LuxelPoint {
  vec3 position, normal;
  std::uint32_t face;
  vec3 reflectance;
  std::array<std::uint8_t, 4> styles;
  std::array<vec3, 4> baked;  // as light: irradiance / pi
};

// Points spread evenly over the area of what has baked light, in the open; about `count`, the same each time.
std::vector<LuxelPoint> choose_luxels(const LitMap& map, const Lightmaps& lightmaps, std::size_t count);

// Adds what lights of negative value took, by their keys: what is left is what the others gave.
void give_back_darkness(const LitMap& map, std::vector<LuxelPoint>& points);

// What a lamp gives a point, irradiance / pi, where nothing stands between; zero where it would be dark on any display.
vec3 unshadowed_light(const EntityLight& lamp, const LuxelPoint& p);

// Irradiance / pi at each point from each emitter at its power, after 0 .. `reflections` reflections.
struct LightTransport {
  std::size_t points = 0, emitters = 0;
  std::array<std::vector<float>, 3> light;      // of a channel: points x emitters, row-major
  std::array<std::vector<float>, 3> straight;   // the same without reflections
  int rays = 0;                                 // from each point over its hemisphere
  std::vector<std::vector<std::uint32_t>> met;  // of points: those that its rays met, whose light it reflects
  std::vector<std::uint8_t> outside;            // of points: 1 where many ways lead out of the map, which leaks
};
LightTransport transport_light(const LitMap& map, const MapEmitters& emitters, const std::vector<LuxelPoint>& points,
                               int reflections);
// The same where emitters differ from those of `former` by their textures' laws of distance (fall_scale) alone: only
// what textures give is computed anew.
LightTransport with_other_falls(const LitMap& map, const MapEmitters& emitters, const std::vector<LuxelPoint>& points,
                                const LightTransport& former, int reflections);

// The same of all emitters times their factors, at any points, by what the mirrors reflect: points whose light is
// known. Negative where most ways lead out of the map.
std::vector<vec3> light_at(const LitMap& map, const MapEmitters& emitters, const std::vector<vec3>& factors,
                           const std::vector<LuxelPoint>& points, const std::vector<LuxelPoint>& mirrors,
                           const std::vector<vec3>& mirrors_light);

}  // namespace fb::scene
