#include "client/input/sticks.h"

#include <algorithm>
#include <cmath>

#include "console/console.h"

namespace fb::cl {
namespace {

constexpr float kStickForwardSpeed = 200.0f, kStickSideSpeed = 225.0f;  // QuakeSpasm's, units a second

void add_pitch(float pitch, const InputSettings& input, vec3& view_angles) {
  view_angles.x = std::clamp(view_angles.x + pitch, std::min(input.min_pitch, input.max_pitch),
                             std::max(input.min_pitch, input.max_pitch));
}

}  // namespace

void register_stick_cvars(con::Console& console) {
#define FB_REGISTER(member, name, initial, least, most, help) \
  console.add_cvar({name, con::number_text(initial), help, con::kCvarArchive, least, most});
  FB_STICK_CVARS(FB_REGISTER)
#undef FB_REGISTER
}

StickSettings read_stick_settings(const con::Console& console) {
  StickSettings settings;
#define FB_READ(member, name, initial, least, most, help) settings.member = console.cvar(name).value();
  FB_STICK_CVARS(FB_READ)
#undef FB_READ
  return settings;
}

vec2 shape_stick(const vec2& stick, float dead, float outer, float exponent) {
  const float length = glm::length(stick);
  if (!(length > dead)) return vec2(0.0f);
  const float range = std::max(1.0f - outer - dead, 0.01f);
  const float part = std::min((length - dead) / range, 1.0f);
  return stick * (std::pow(part, exponent) / length);
}

bool apply_look_stick(const Sticks& sticks, const StickSettings& s, const InputSettings& input, double seconds,
                      vec3& view_angles) {
  if (s.enable == 0.0f) return false;
  const vec2 look =
      shape_stick(s.swap != 0.0f ? sticks.left : sticks.right, s.dead_look, s.outer_look, s.exponent_look);
  const auto time = static_cast<float>(seconds);
  view_angles.y -= time * s.yaw_speed * look.x;
  const float pitch = time * s.pitch_speed * look.y * (s.invert != 0.0f ? -1.0f : 1.0f);
  if (pitch == 0.0f) return false;
  add_pitch(pitch, input, view_angles);
  return true;
}

bool apply_gyro(const Sticks& sticks, const StickSettings& s, const InputSettings& input, bool action, double seconds,
                vec3& view_angles) {
  const bool counts = s.gyro_mode == 0.0f || (s.gyro_mode == 1.0f) == action;
  if (s.enable == 0.0f || s.gyro == 0.0f || !counts) return false;
  if (glm::length(sticks.turned) < s.gyro_noise * static_cast<float>(seconds)) return false;
  view_angles.y += s.gyro_yaw * (s.gyro_axis != 0.0f ? sticks.turned.z : sticks.turned.y);
  const float pitch = -s.gyro_pitch * sticks.turned.x;
  if (pitch == 0.0f) return false;
  add_pitch(pitch, input, view_angles);
  return true;
}

UserMove stick_move(const Sticks& sticks, const StickSettings& s, const InputSettings& input, bool runs) {
  UserMove move;
  if (s.enable == 0.0f) return move;
  const vec2 stick =
      shape_stick(s.swap != 0.0f ? sticks.right : sticks.left, s.dead_move, s.outer_move, s.exponent_move);
  const float factor = runs ? input.move_speed_key : 1.0f;
  move.side = factor * kStickSideSpeed * stick.x;
  move.forward = -factor * kStickForwardSpeed * stick.y;
  return move;
}

}  // namespace fb::cl
