#include "scene/library/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "scene/library/asset_builder.h"
#include "shared/spot.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

using world::Entity;

constexpr float kLightmapUnit = 128.0f;       // the lightmap value that shows a texture as it was painted
constexpr float kMaxSurfaceRadiance = 20.0f;  // small faces would be blinding
constexpr float kDefaultLight = 300.0f;
constexpr float kMaxLight = 1e5f, kMinWait = 0.01f;  // beyond these are typing errors
constexpr float kLightToolRange = 0.5f;              // light tools halve what they have added up
constexpr float kMaxLightmap = 255.0f;
constexpr float kUsualAngleScale = 0.5f;
constexpr float kDefaultCone = 40.0f;  // degrees
constexpr float kMinSunRadius = 1.0f;  // degrees: smaller suns are all noise to a path tracer without light sampling

// A key with or without its leading underscore.
std::string_view either(const Entity& entity, std::string_view key_with_underscore) {
  return entity.has(key_with_underscore) ? key_with_underscore : key_with_underscore.substr(1);
}

vec3 linear_color(const vec3& encoded) {
  return {linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z)};
}

vec3 light_color(const Entity& entity, std::string_view key) {
  return linear_color(entity.color(either(entity, key)).value_or(vec3(1.0f)));
}

struct LightValue {
  float value;
  vec3 color;
};
// "light" "300", or Half-Life's "_light" "r g b brightness".
LightValue light_value(const Entity& entity) {
  LightValue result{kDefaultLight, light_color(entity, "_color")};
  const std::string_view key = entity.has("light") ? "light" : "_light";
  const std::vector<float> numbers = world::parse_numbers(entity.text(key), 4);
  if (numbers.size() == 4) {
    result.value = numbers[3];
    result.color = linear_color(glm::clamp(vec3(numbers[0], numbers[1], numbers[2]) / 255.0f, vec3(0.0f), vec3(1.0f)));
  } else if (!numbers.empty() && numbers[0] != 0.0f) {
    result.value = numbers[0];
  }
  return result;
}

// By how much less than at right angles a light counts where it grazes, 0 to 1 ("_anglescale", "_anglesense"), in the
// tools 0.5 unless said. Here it is Lambert's law for all, which is 1: what is said below 0.5 makes a light as much
// stronger as faces turned every way get by it, up to a third.
float angle_strength(const Entity& entity) {
  const std::string_view key =
      either(entity, entity.has(either(entity, "_anglescale")) ? "_anglescale" : "_anglesense");
  const float angle = std::clamp(entity.number(key, kUsualAngleScale), 0.0f, 1.0f);
  const auto mean_of_ways = [](float a) { return 1.0f - 0.5f * a; };
  return std::max(1.0f, mean_of_ways(angle) / mean_of_ways(kUsualAngleScale));
}

// The keys of a light that its strength and its law of distance come from. "_falloff", where a linear one ends, counts
// instead of "wait"; "_dist" and "_range" of the world are factors for all.
struct LightLaw {
  float value, wait;
  int delay;
  float factor;  // on the strength
  float strength() const { return factor * light_strength(value, wait, delay); }
};
LightLaw light_law(const Entity& entity, float value, const Entity& world) {
  LightLaw law{value, entity.number(either(entity, "_wait"), 1.0f), entity.integer(either(entity, "_delay"), 0),
               angle_strength(entity)};
  const float falloff = entity.number("_falloff", 0.0f);
  const auto world_factor = [&](std::string_view key, float usual) {
    const float x = world.number(key, usual);
    return x > 0.0f ? x / usual : 1.0f;
  };
  const bool linear = law.delay < 1 || law.delay > 5;
  if (linear && falloff > 0.0f)
    law.wait = std::fabs(value) / falloff;
  else
    law.wait = (law.wait > 0.0f ? law.wait : 1.0f) * world_factor("_dist", 1.0f);
  law.factor *= world_factor("_range", kLightToolRange);
  return law;
}

// The way that a spot shines: to what it targets, or by its mangle, of which positive pitch is up.
std::optional<vec3> spot_axis(const Entity& entity, const std::vector<Entity>& entities) {
  if (entity.has("target")) {
    const auto target = std::ranges::find(entities, entity.text("target"),
                                          [](const Entity& other) { return other.text("targetname"); });
    if (target != entities.end()) {
      const vec3 way = target->vector("origin").value_or(vec3(0)) - entity.vector("origin").value_or(vec3(0));
      if (glm::length(way) > 0.0f) return glm::normalize(way);
    }
  }
  if (const auto mangle = entity.vector("mangle")) return angle_vectors({-mangle->y, mangle->x, 0.0f}).forward;
  return std::nullopt;
}

void aim(EntityLight& light, const Entity& entity, const std::vector<Entity>& entities) {
  const std::optional<vec3> axis = spot_axis(entity, entities);
  if (!axis) return;
  const auto half_cosine = [](float cone) { return std::cos(radians(std::min(cone, 360.0f) * 0.5f)); };
  const float angle = entity.number("angle", 0.0f), soft = entity.number(either(entity, "_softangle"), 0.0f);
  light.axis = *axis;
  light.least_cosine = half_cosine(angle > 0.0f ? angle : kDefaultCone);
  light.full_cosine = std::max(half_cosine(soft), light.least_cosine);
  if (!(soft > 0.0f)) light.full_cosine = light.least_cosine;
}

// "_nostaticlight": for engines' own lights, the tools pass it over.
bool is_light(const Entity& entity) {
  return entity.classname().starts_with("light") && !(entity.number("_nostaticlight", 0.0f) > 0.0f);
}
bool is_sun_entity(const Entity& entity) { return entity.number("_sun", 0.0f) > 0.0f; }
// It stands for the world's key of that name.
bool is_dome_entity(const Entity& entity, std::string_view key) { return entity.number(key, 0.0f) > 0.0f; }
bool is_lamp(const Entity& entity) {
  return is_light(entity) && !is_sun_entity(entity) && !is_dome_entity(entity, "_sunlight2") &&
         !is_dome_entity(entity, "_sunlight3") && !entity.has("_surface");
}

// The tools write the style that a game's QuakeC switches.
constexpr int kFirstSwitchedStyle = 32;
bool begins_off(const Entity& entity) { return entity.has("targetname") && (entity.integer("spawnflags", 0) & 1) != 0; }

std::array<vec3, 14> directions() {
  std::array<vec3, 14> all;
  std::size_t n = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (float sign : {-1.0f, 1.0f}) {
      all[n] = vec3(0.0f);
      all[n++][axis] = sign;
    }
  for (float x : {-1.0f, 1.0f})
    for (float y : {-1.0f, 1.0f})
      for (float z : {-1.0f, 1.0f}) all[n++] = glm::normalize(vec3(x, y, z));
  return all;
}

bool is_solid(const formats::Bsp& bsp, const vec3& p) {
  const std::int32_t contents = world::point_contents(bsp, p);
  return contents == formats::kContentsSolid || contents == formats::kContentsSky;
}

// The nearest open point among steps of 2 units along the directions.
std::optional<vec3> nearest_open(const formats::Bsp& bsp, const vec3& p) {
  if (!is_solid(bsp, p)) return p;
  for (float distance = 2.0f; distance <= 24.0f; distance += 2.0f)
    for (const vec3& d : directions())
      if (!is_solid(bsp, p + d * distance)) return p + d * distance;
  return std::nullopt;
}

// How far the nearest wall is along the directions, at most `limit`.
float room_around(const formats::Bsp& bsp, const vec3& p, float limit) {
  float room = limit;
  for (const vec3& d : directions()) {
    const world::LineHit hit = world::trace_line(bsp, p, p + d * limit);
    // Distance to the plane rather than along the line.
    if (hit.hit) room = std::min(room, hit.fraction * limit * std::fabs(glm::dot(hit.normal, d)));
  }
  return room;
}

// Pushes a sphere's centre away from walls that it would cut.
vec3 push_off_walls(const formats::Bsp& bsp, vec3 p, float radius) {
  for (int round = 0; round < 4; ++round) {
    vec3 best = p;
    float best_room = room_around(bsp, p, radius);
    if (best_room >= radius) break;
    for (const vec3& d : directions()) {
      const float reach = 0.5f * radius;
      const world::LineHit hit = world::trace_line(bsp, p, p + d * reach);
      const vec3 candidate = p + d * (reach * hit.fraction * (hit.hit ? 0.5f : 1.0f));
      const float room = room_around(bsp, candidate, radius);
      if (room > best_room + 0.01f) {
        best = candidate;
        best_room = room;
      }
    }
    if (best == p) break;
    p = best;
  }
  return p;
}

vec3 minimum_light(const Entity& entity, float value) {
  if (!(value > 0.0f)) return vec3(0.0f);
  const bool long_name = entity.has(either(entity, "_minlight_color"));
  const vec3 color = entity.color(either(entity, long_name ? "_minlight_color" : "_mincolor")).value_or(vec3(1.0f));
  return linear_color(color * (std::min(kLightToolRange * value, kMaxLightmap) / kLightmapUnit));
}

// Yaw and pitch of a mangle give the way the light goes; positive pitch is up, unlike Quake's view angles.
vec3 towards_sun(const vec3& mangle) { return -angle_vectors({-mangle.y, mangle.x, 0.0f}).forward; }

float dome_of_world(const Entity& world, std::string_view key) {
  return std::max(0.0f, world.number(either(world, key), 0.0f)) / kLightmapUnit;
}

Sun make_sun(float value, const vec3& color, const vec3& direction, float penumbra) {
  Sun sun;
  sun.direction = direction;
  sun.irradiance = color * (kPi * std::min(value, kMaxLight) / kLightmapUnit);
  sun.angular_radius = std::clamp(0.5f * penumbra, kMinSunRadius, 45.0f);
  return sun;
}

}  // namespace

float light_strength(float value, float wait, int delay) {
  if (!(value > 0.0f)) return 0.0f;
  value = std::min(value, kMaxLight);
  const float w = wait > 0.0f ? std::max(wait, kMinWait) : 1.0f;
  switch (delay) {
    case 1:
    case 2:
      return value * kLightmapUnit / (w * w);
    case 3:
      return value * kLightmapUnit;
    case 4:
      return 0.0f;
    case 5:
      return value * kLightmapUnit / (4.0f * w * w);
    default: {
      const float half = value / (2.0f * w);
      return value / (2.0f * kLightmapUnit) * half * half;
    }
  }
}

void set_fall(EntityLight& light, float value, float wait, int delay) {
  const float w = wait > 0.0f ? std::max(wait, kMinWait) : 1.0f;
  light.fall = shared::kFallSquare;
  light.fall_scale = w / kLightmapUnit;
  switch (delay) {
    case 1:
      light.fall = shared::kFallInverse;
      break;
    case 2:
      break;
    case 3:
      light.fall = shared::kFallNone;
      light.fall_scale = 1.0f / kLightmapUnit;
      break;
    case 5:
      light.fall = shared::kFallOffset;
      break;
    default:
      light.fall = shared::kFallLinear;
      light.fall_scale = 2.0f * w / std::clamp(value, 1.0f, kMaxLight);
  }
}

namespace {

// Of lights whose value has this sign.
std::vector<EntityLight> lamps_of(const std::vector<Entity>& entities, const formats::Bsp& bsp, float sign) {
  std::vector<EntityLight> lights;
  if (bsp.models.empty()) return lights;
  for (const Entity& entity : entities) {
    if (!is_lamp(entity)) continue;
    LightValue light = light_value(entity);
    light.value *= sign;
    const LightLaw law = light_law(entity, light.value, entities.front());
    const float strength = law.strength();
    if (!(strength > 0.0f) || light.color == vec3(0.0f)) continue;
    const vec3 origin = entity.vector("origin").value_or(vec3(0.0f));
    if (!(glm::length(origin) < formats::kMaxBspCoordinate)) continue;
    const std::optional<vec3> open = nearest_open(bsp, origin);
    if (!open) continue;
    EntityLight sphere;
    sphere.position = push_off_walls(bsp, *open, kLightRadius);
    sphere.radius = std::max(room_around(bsp, sphere.position, kLightRadius), kMinLightRadius);
    sphere.power_color = light.color * (strength / (sphere.radius * sphere.radius));
    sphere.style = std::clamp(entity.integer("style", 0), 0, 63);
    aim(sphere, entity, entities);
    set_fall(sphere, law.value, law.wait, law.delay);
    lights.push_back(sphere);
  }
  return lights;
}

}  // namespace

std::vector<EntityLight> entity_lights(const std::vector<Entity>& entities, const formats::Bsp& bsp) {
  return lamps_of(entities, bsp, 1.0f);
}

std::vector<EntityLight> darkening_lights(const std::vector<Entity>& entities, const formats::Bsp& bsp) {
  return lamps_of(entities, bsp, -1.0f);
}

namespace {

// The light of one _surface entity; radiance 0 where no face has its texture.
SurfaceLight surface_light(const Entity& entity, const Entity& world, const std::string& name,
                           const formats::Bsp& bsp) {
  double area = 0.0, patches = 0.0;
  for (const formats::BspFace& face : bsp.faces) {
    const std::uint32_t texture = bsp.texinfos[face.texinfo].texture;
    if (texture >= bsp.textures.size() || lower_case(bsp.textures[texture].name) != name) continue;
    const double a = world::face_area(bsp, face);
    area += a;
    patches += std::max(1.0, std::ceil(a / (128.0 * 128.0)));
  }
  const LightValue light = light_value(entity);
  const LightLaw keys = light_law(entity, light.value, world);
  const float strength = keys.strength();
  SurfaceLight surface;
  if (area < 1.0 || !(strength > 0.0f)) return surface;
  // A patch of radiance R' and area A has the intensity R' A to its front; the sphere has pi r^2 R.
  const auto radiance = static_cast<float>(kPi * strength * patches / area);
  surface.radiance = light.color * std::min(radiance, kMaxSurfaceRadiance);
  surface.style = std::clamp(entity.integer("style", 0), 0, 63);
  EntityLight law;
  set_fall(law, keys.value, keys.wait, keys.delay);
  surface.fall_scale = law.fall == shared::kFallLinear ? law.fall_scale : 0.0f;
  surface.switched = begins_off(entity);
  return surface;
}

}  // namespace

SurfaceLights surface_lights(const std::vector<Entity>& entities, const formats::Bsp& bsp) {
  SurfaceLights result;
  for (const bool switched : {false, true})  // a texture that glows from the start has one light, without a switch
    for (const Entity& entity : entities) {
      if (!is_light(entity) || !entity.has("_surface") || begins_off(entity) != switched) continue;
      if (switched && entity.integer("style", 0) < kFirstSwitchedStyle) continue;
      const std::string name = lower_case(entity.text("_surface"));
      const SurfaceLight light = surface_light(entity, entities.front(), name, bsp);
      if (light.radiance == vec3(0.0f)) continue;
      const auto [at, added] = result.try_emplace(name, light);
      if (added || (switched && !at->second.switched)) continue;
      const vec3 sum = at->second.radiance + light.radiance;
      at->second = light;
      at->second.radiance = sum;
    }
  return result;
}

std::vector<Sun> suns(const std::vector<Entity>& entities) {
  std::vector<Sun> result;
  if (entities.empty()) return result;
  const Entity& world = entities.front();
  const auto number = [&](std::string_view key) { return world.number(either(world, key), 0.0f); };
  const float penumbra = number("_sunlight_penumbra"), angles = angle_strength(world);
  const vec3 down(0.0f, -90.0f, 0.0f);
  const auto mangle_of = [&](std::initializer_list<std::string_view> keys) {
    for (std::string_view key : keys) {
      const std::vector<float> numbers = world::parse_numbers(world.text(either(world, key)), 3);
      if (numbers.size() >= 2) return vec3(numbers[0], numbers[1], 0.0f);
    }
    return down;
  };
  if (const float value = number("_sunlight"); value > 0.0f)
    result.push_back(make_sun(value * angles, light_color(world, "_sunlight_color"),
                              towards_sun(mangle_of({"_sun_mangle", "_sunlight_mangle", "_sun_angle"})), penumbra));
  if (const float value = number("_sun2"); value > 0.0f)
    result.push_back(make_sun(value * angles, light_color(world, "_sun2_color"),
                              towards_sun(mangle_of({"_sun2_mangle"})), penumbra));
  for (const Entity& entity : entities) {
    if (!is_light(entity) || !is_sun_entity(entity)) continue;
    const LightValue light = light_value(entity);
    if (!(light.value > 0.0f)) continue;
    vec3 direction = towards_sun(entity.vector("mangle").value_or(down));
    // Or from the entity to what it targets.
    const auto target = std::ranges::find_if(entities, [&](const Entity& other) {
      return entity.has("target") && other.text("targetname") == entity.text("target");
    });
    if (target != entities.end()) {
      const vec3 way = target->vector("origin").value_or(vec3(0)) - entity.vector("origin").value_or(vec3(0));
      if (glm::length(way) > 0.0f) direction = -glm::normalize(way);
    }
    result.push_back(make_sun(light.value * angle_strength(entity), light.color, direction,
                              entity.number("_deviance", 0.0f) * 2.0f));
  }
  return result;
}

float white_dome_radiance(const std::vector<Entity>& entities) {
  return entities.empty() ? 0.0f : dome_of_world(entities.front(), "_sunlight2");
}

vec3 dome_radiance(const std::vector<Entity>& entities, bool sky_below) {
  if (entities.empty()) return vec3(0.0f);
  const Entity& world = entities.front();
  const auto half = [&](std::string_view key, std::string_view color, std::string_view other_color) {
    vec3 sum = dome_of_world(world, key) * light_color(world, world.has(either(world, color)) ? color : other_color);
    for (const Entity& entity : entities)
      if (&entity != &world && is_light(entity) && is_dome_entity(entity, key)) {
        const LightValue light = light_value(entity);
        sum += light.color * (std::clamp(light.value, 0.0f, kMaxLight) / kLightmapUnit);
      }
    return sum;
  };
  const vec3 upper = half("_sunlight2", "_sunlight2_color", "_sunlight_color2");
  return sky_below ? glm::max(upper, half("_sunlight3", "_sunlight3_color", "_sunlight_color3")) : upper;
}

vec3 ambient_radiance(const std::vector<Entity>& entities) {
  if (entities.empty()) return vec3(0.0f);
  const Entity& world = entities.front();
  return minimum_light(
      world, world.number(world.has(either(world, "_minlight")) ? either(world, "_minlight") : "light", 0.0f));
}

vec3 minimum_light(const Entity& entity) {
  return minimum_light(entity, entity.number(either(entity, "_minlight"), 0.0f));
}

}  // namespace fb::scene
