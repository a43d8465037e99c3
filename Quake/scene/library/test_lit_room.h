// For tests: a cube of a room whose faces have baked light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "scene/library/lit_map.h"
#include "scene/library/test_maps.h"
#include "shared/tone.h"

namespace fb::scene::test {

constexpr float kLitRoom = 512.0f;                       // units a side, from the origin
constexpr float kLitReflectance = 0.02f;                 // of its walls: what they reflect hardly counts
constexpr std::uint32_t kLitFloor = 4, kLitCeiling = 5;  // faces; the walls stand before them: x = 0, x = side, y ...

// Face 2 a is where axis a is 0, face 2 a + 1 where it is kLitRoom; one leaf is open, all else is solid.
inline MapBuilder lit_room(bool sky_above = false) {
  MapBuilder map;
  const std::uint32_t wall = map.add_texture(texture("wall"));
  const std::uint32_t above = sky_above ? map.add_texture(texture("sky1")) : wall;
  for (int side = 0; side < 6; ++side) {
    const int a = side / 2, u = (a + 1) % 3, v = (a + 2) % 3;
    const bool far_side = side % 2 != 0;
    std::vector<vec3> corners(4, vec3(0.0f));
    for (int k = 0; k < 4; ++k) {
      corners[static_cast<std::size_t>(k)][a] = far_side ? kLitRoom : 0.0f;
      corners[static_cast<std::size_t>(k)][u] = k == 1 || k == 2 ? kLitRoom : 0.0f;
      corners[static_cast<std::size_t>(k)][v] = k >= 2 ? kLitRoom : 0.0f;
    }
    if (!far_side) std::ranges::reverse(corners);
    vec3 normal(0.0f);
    normal[a] = far_side ? -1.0f : 1.0f;
    map.add_face(corners, normal, side == static_cast<int>(kLitCeiling) ? above : wall);
    std::array<vec4, 2> axes{vec4(0.0f), vec4(0.0f)};
    axes[0][u] = axes[1][v] = 1.0f;
    map.bsp.texinfos.back().axes = axes;
    formats::BspNode node{};
    node.plane = map.bsp.faces.back().plane;
    node.children = {side == 5 ? ~1 : side + 1, ~0};
    node.first_face = static_cast<std::uint32_t>(side);
    node.face_count = 1;
    map.bsp.nodes.push_back(node);
  }
  map.bsp.models[0].head_nodes[0] = 0;
  return map;
}

// The surfaces of such a room, and nothing that shines.
inline LitMap lit_map(const formats::Bsp& bsp) {
  LitMap map{bsp, {}, {}, {}, vec3(0.0f), vec3(0.0f), {}, {}};
  for (std::uint32_t t = 0; t < bsp.textures.size(); ++t)
    map.surfaces.push_back({t, bsp.textures[t].name, vec3(kLitReflectance), vec3(0.0f)});
  return map;
}

// A lamp of that intensity: radiance times radius^2.
inline EntityLight lit_lamp(const vec3& position, float intensity, int style = 0) {
  EntityLight lamp{};
  lamp.position = position;
  lamp.radius = 8.0f;
  lamp.power_color = vec3(intensity / 64.0f);
  lamp.style = style;
  return lamp;
}

// Gives each face luxels, 16 units apart: the values that display this light (irradiance / pi at a point by its
// normal).
inline void bake(formats::Bsp& bsp, const std::function<float(const vec3&, const vec3&)>& light,
                 std::uint8_t style = 0) {
  const auto encoded = [](float linear) { return shared::srgb_from_linear(vec3(linear)).x; };
  constexpr int kLuxels = static_cast<int>(kLitRoom) / 16 + 1;
  for (std::uint32_t f = 0; f < 6; ++f) {
    bsp.faces[f].light_offset = static_cast<std::int32_t>(bsp.lighting.size());
    bsp.faces[f].styles = {style, 255, 255, 255};
    const int a = static_cast<int>(f) / 2, u = (a + 1) % 3, v = (a + 2) % 3;
    vec3 normal(0.0f);
    normal[a] = f % 2 != 0 ? -1.0f : 1.0f;
    for (int t = 0; t < kLuxels; ++t)
      for (int s = 0; s < kLuxels; ++s) {
        vec3 p(0.0f);
        p[a] = f % 2 != 0 ? kLitRoom : 0.0f;
        p[u] = 16.0f * static_cast<float>(s);
        p[v] = 16.0f * static_cast<float>(t);
        const float value = encoded(light(p, normal) * kLitReflectance) / encoded(kLitReflectance) * 128.0f;
        bsp.lighting.push_back(static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f)));
      }
  }
}

inline float lamp_light(const EntityLight& lamp, const vec3& point, const vec3& normal) {
  const vec3 way = lamp.position - point;
  const float d = glm::length(way);
  return lamp.power_color.x * lamp.radius * lamp.radius * std::max(glm::dot(way, normal), 0.0f) / (d * d * d);
}

}  // namespace fb::scene::test
