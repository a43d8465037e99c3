#include "client/session/view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/number.h"
#include "world/bsp_query.h"

namespace fb::cl {
namespace {

constexpr float kStairSpeed = 100.0f;  // units a second that the eye climbs
constexpr float kStairMost = 24.0f;    // units that it may lag behind

vec3 idle_sway(const Settings& s, float scale, double time) {
  const auto wave = [&](float cycle, float level) {
    return scale * level * static_cast<float>(std::sin(time * static_cast<double>(cycle)));
  };
  return {wave(s.v_ipitch_cycle, s.v_ipitch_level), wave(s.v_iyaw_cycle, s.v_iyaw_level),
          wave(s.v_iroll_cycle, s.v_iroll_level)};
}

// Tilt by movement and damage, and lying down when dead.
void add_roll(ClientState& state, const Settings& s, const Entity& player, double seconds, vec3& angles) {
  angles.z += calculate_roll(s, player.angles, state.velocity);
  if (state.damage_time > 0.0f && s.v_kicktime > 0.0f) {
    const float left = state.damage_time / s.v_kicktime;
    angles.z += left * state.damage_roll;
    angles.x += left * state.damage_pitch;
    state.damage_time -= static_cast<float>(seconds);
  }
  if (state.hud.stats[net::kStatHealth] <= 0) angles.z = 80.0f;
}

// The kick of a weapon, as the server said it or gliding there within a tenth of a second.
vec3 gun_kick(const ClientState& state, const Settings& s, ViewMemory& memory, double seconds) {
  if (s.v_gunkick == 1.0f) return state.punch;
  if (s.v_gunkick != 2.0f) return vec3(0.0f);
  for (int i = 0; i < 3; ++i) {
    const float target = state.punches[0][i];
    const float step = (target - state.punches[1][i]) * static_cast<float>(seconds) * 10.0f;
    float& punch = memory.punch[i];
    if (punch == target) continue;
    if (step > 0.0f)
      punch = std::min(punch + step, target);
    else if (step < 0.0f)
      punch = std::max(punch + step, target);
  }
  return memory.punch;
}

// How far the eye stays below where the player has stepped up to: 0 or negative.
float stair_offset(const ClientState& state, float z, ViewMemory& memory) {
  if (memory.fresh || !state.on_ground || state.on_elevator || z <= memory.stair_height) {
    memory.stair_height = z;
    return 0.0f;
  }
  const auto seconds = static_cast<float>(std::max(0.0, state.time - state.old_time));
  memory.stair_height = std::min(memory.stair_height + seconds * kStairSpeed, z);
  memory.stair_height = std::max(memory.stair_height, z - kStairMost);
  return memory.stair_height - z;
}

// QuakeSpasm lifts the weapon with r_viewmodel_quake as Quake did for its status bar.
float weapon_lift(const Settings& s) {
  if (s.r_viewmodel_quake == 0.0f) return 0.0f;
  if (s.viewsize == 100.0f) return 2.0f;
  if (s.viewsize == 110.0f || s.viewsize == 90.0f) return 1.0f;
  return s.viewsize == 80.0f ? 0.5f : 0.0f;
}

// Behind the player, looking at what the player looks at.
void chase(const Settings& s, const formats::Bsp* map, View& view) {
  const AxisVectors axes = angle_vectors(view.angles);
  vec3 camera = view.origin - axes.forward * s.chase_back + axes.right * s.chase_right;
  camera.z = view.origin.z + s.chase_up;
  vec3 target = view.origin + axes.forward * 4096.0f;
  if (map) {
    const auto stop = [&](const vec3& from, const vec3& to) {
      const world::LineHit hit = world::trace_line(*map, from, to);
      return from + (to - from) * hit.fraction;
    };
    target = stop(view.origin, target);
    const vec3 reached = stop(view.origin, camera);
    if (reached != camera) camera = view.origin + (reached - view.origin) * 0.9f;  // stay out of walls
  }
  const vec3 along = target - camera;
  view.origin = camera;
  if (glm::dot(along, along) > 0.0f) {
    view.angles.x = -degrees(std::atan2(along.z, std::sqrt(along.x * along.x + along.y * along.y)));
    view.angles.y = degrees(std::atan2(along.y, along.x));
  }
}

void set_contents_shift(ClientState& state, std::int32_t contents) {
  switch (contents) {
    case formats::kContentsEmpty:
    case formats::kContentsSolid:
    case formats::kContentsSky:
      state.shifts[kShiftContents] = state.empty_shift;
      break;
    case formats::kContentsLava:
      state.shifts[kShiftContents] = {vec3(255, 80, 0), 150.0f};
      break;
    case formats::kContentsSlime:
      state.shifts[kShiftContents] = {vec3(0, 25, 5), 150.0f};
      break;
    default:
      state.shifts[kShiftContents] = {vec3(130, 80, 50), 128.0f};
      break;
  }
}

void set_powerup_shift(ClientState& state) {
  const auto items = static_cast<std::uint32_t>(state.hud.items);
  ColorShift& shift = state.shifts[kShiftPowerup];
  if (items & kItemQuad)
    shift = {vec3(0, 0, 255), 30.0f};
  else if (items & kItemSuit)
    shift = {vec3(0, 255, 0), 20.0f};
  else if (items & kItemInvisibility)
    shift = {vec3(100, 100, 100), 100.0f};
  else if (items & kItemInvulnerability)
    shift = {vec3(255, 255, 0), 30.0f};
  else
    shift.percent = 0.0f;
}

// What a brush model whose skin says so (FTE_ENT_SKIN_CONTENTS) holds at a point; skins are sent as bytes. Nothing
// where there is none. Models are not turned, as for collisions.
std::optional<std::int32_t> contents_by_skin(const ClientState& state, const formats::Bsp& map, const vec3& point) {
  constexpr int kFirstSkin = 256 - 16, kByte = 256;
  for (const Entity& entity : state.entities) {
    const auto model = static_cast<std::size_t>(std::max(entity.model, 0));
    if (entity.skin < kFirstSkin || entity.skin >= kByte || model >= state.model_names.size()) continue;
    if (entity.message_time != state.message_times[0] || !state.model_names[model].starts_with('*')) continue;
    const auto submodel = parse_whole_number_unsigned(std::string_view(state.model_names[model]).substr(1));
    if (!submodel || *submodel < 1 || *submodel >= map.models.size()) continue;
    const vec3 there = point - entity.origin;
    if (world::point_contents(map, there, static_cast<std::uint32_t>(*submodel)) != formats::kContentsEmpty)
      return entity.skin - kByte;
  }
  return std::nullopt;
}

void color_picture(Session& session, const formats::Bsp* map, double seconds, View& view) {
  ClientState& state = session.state;
  std::int32_t contents = formats::kContentsEmpty;
  if (map) contents = contents_by_skin(state, *map, view.origin).value_or(world::point_contents(*map, view.origin));
  set_contents_shift(state, contents);
  set_powerup_shift(state);
  view.tint = blend_shifts(state, session.settings);
  view.tint_without_contents = blend_shifts(state, session.settings, false);
  const auto fade = [seconds](ColorShift& shift, float speed) {
    shift.percent = std::max(0.0f, shift.percent - static_cast<float>(seconds) * speed);
  };
  fade(state.shifts[kShiftDamage], 150.0f);
  fade(state.shifts[kShiftBonus], 100.0f);
}

}  // namespace

float calculate_roll(const Settings& s, const vec3& angles, const vec3& velocity) {
  const float side = glm::dot(velocity, angle_vectors(angles).right);
  const float amount = std::abs(side);
  const float roll = amount < s.cl_rollspeed ? amount * s.cl_rollangle / s.cl_rollspeed : s.cl_rollangle;
  return side < 0.0f ? -roll : roll;
}

float calculate_bob(const Settings& s, const vec3& velocity, double time) {
  if (!(s.cl_bobcycle > 0.0f)) return 0.0f;
  const double cycle_length = s.cl_bobcycle;
  auto cycle = static_cast<float>((time - std::trunc(time / cycle_length) * cycle_length) / cycle_length);
  if (cycle < s.cl_bobup)
    cycle = kPi * cycle / s.cl_bobup;
  else
    cycle = s.cl_bobup < 1.0f ? kPi + kPi * (cycle - s.cl_bobup) / (1.0f - s.cl_bobup) : kPi;
  // By the speed over ground: falling does not bob.
  const float bob = std::sqrt(velocity.x * velocity.x + velocity.y * velocity.y) * s.cl_bob;
  return std::clamp(bob * 0.3f + bob * 0.7f * std::sin(cycle), -7.0f, 4.0f);
}

vec4 blend_shifts(const ClientState& state, const Settings& s, bool contents) {
  const std::array<float, kShiftCount> strengths = {s.gl_cshiftpercent_contents, s.gl_cshiftpercent_damage,
                                                    s.gl_cshiftpercent_bonus, s.gl_cshiftpercent_powerup};
  vec3 color(0.0f);
  float alpha = 0.0f;
  for (std::size_t i = 0; i < kShiftCount; ++i) {
    if (state.hud.intermission != Intermission::kNone && i != kShiftContents) continue;
    if (i == kShiftContents && !contents) continue;
    const float weight = state.shifts[i].percent / 255.0f * (s.gl_cshiftpercent / 100.0f) * (strengths[i] / 100.0f);
    if (!(weight > 0.0f)) continue;
    alpha += weight * (1.0f - alpha);
    color = glm::mix(color, state.shifts[i].color, weight / alpha);
  }
  if (s.gl_polyblend == 0.0f) return vec4(0.0f);
  return vec4(glm::clamp(color / 255.0f, 0.0f, 1.0f), std::clamp(alpha, 0.0f, 1.0f));
}

float adapted_fov(float fov, bool adapt, int width, int height) {
  const float narrow = std::max(10.0f, std::min(fov, 170.0f));  // QuakeSpasm's limits; 10 for what is no number
  if (!adapt || width <= 0 || height <= 0) return narrow;
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return degrees(2.0f * std::atan(0.75f * aspect * std::tan(radians(narrow) * 0.5f)));
}

View calculate_view(Session& session, ViewMemory& memory, const formats::Bsp* map, double seconds) {
  ClientState& state = session.state;
  const Settings& s = session.settings;
  View view;
  Entity* player = state.view_entity_state();
  if (!player) return view;

  if (state.hud.intermission != Intermission::kNone) {
    view.origin = player->origin;
    view.angles = player->angles + idle_sway(s, 1.0f, state.time);
    color_picture(session, map, seconds, view);
    return view;
  }

  // The body faces where the eyes look; entities' pitch is backwards.
  player->angles.y = state.view_angles.y;
  player->angles.x = -state.view_angles.x;

  const float bob = calculate_bob(s, state.velocity, state.time);
  // Off the planes of liquids, which lie on whole units.
  view.origin = player->origin + vec3(0, 0, static_cast<float>(state.view_height) + bob) + vec3(1.0f / 32);
  view.angles = state.view_angles;
  add_roll(state, s, *player, seconds, view.angles);
  view.angles += idle_sway(s, s.v_idlescale, state.time);

  const AxisVectors axes = angle_vectors({-player->angles.x, player->angles.y, player->angles.z});
  if (state.hud.max_clients <= 1)
    view.origin += s.scr_ofsx * axes.forward + s.scr_ofsy * axes.right + s.scr_ofsz * axes.up;
  view.origin = glm::clamp(view.origin, player->origin - vec3(14, 14, 22), player->origin + vec3(14, 14, 30));

  // The weapon follows the view, but for its roll and the weapon's kick, and sways against it.
  const vec3 against = idle_sway(s, s.v_idlescale, state.time);
  view.weapon_angles = {-view.angles.x - against.x, view.angles.y - against.y, state.view_angles.z - against.z};
  view.weapon_origin = player->origin + axes.forward * (bob * 0.4f) +
                       vec3(0, 0, static_cast<float>(state.view_height) + bob + weapon_lift(s));
  const auto items = static_cast<std::uint32_t>(state.hud.items);
  view.show_weapon = s.r_drawviewmodel != 0.0f && s.chase_active == 0.0f && !(items & kItemInvisibility) &&
                     state.hud.stats[net::kStatHealth] > 0;

  view.angles += gun_kick(state, s, memory, seconds);

  const float stair = stair_offset(state, player->origin.z, memory);
  view.origin.z += stair;
  view.weapon_origin.z += stair;
  memory.fresh = false;

  if (s.chase_active != 0.0f) chase(s, map, view);
  color_picture(session, map, seconds, view);
  return view;
}

}  // namespace fb::cl
