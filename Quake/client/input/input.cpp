#include "client/input/input.h"

#include <algorithm>
#include <cmath>

#include "console/console.h"

namespace fb::cl {
namespace {

constexpr float kMostRoll = 50.0f;
constexpr float kMostMove = 32767.0f;  // what clc_move holds

// Yaw in 65536ths of a turn, as Quake keeps it; cut, not rounded.
float whole_yaw(float degrees) {
  if (!std::isfinite(degrees)) return 0.0f;
  const double steps = std::fmod(static_cast<double>(degrees) * (65536.0 / 360.0), 65536.0);
  return static_cast<float>((360.0 / 65536.0) * static_cast<double>(static_cast<int>(steps) & 65535));
}

void clamp_pitch(const InputSettings& settings, vec3& view_angles) {
  view_angles.x = std::max(std::min(view_angles.x, settings.max_pitch), settings.min_pitch);
}

int whole_speed(float speed) {
  return std::isfinite(speed) ? static_cast<int>(std::clamp(speed, -kMostMove, kMostMove)) : 0;
}

}  // namespace

bool Button::press(int key) {
  if (key == keys_[0] || key == keys_[1]) return true;
  if (keys_[0] == 0)
    keys_[0] = key;
  else if (keys_[1] == 0)
    keys_[1] = key;
  else
    return false;
  if (!down_) down_ = went_down_ = true;
  return true;
}

void Button::release(int key) {
  if (keys_[0] == key)
    keys_[0] = 0;
  else if (keys_[1] == key)
    keys_[1] = 0;
  else
    return;  // pressed elsewhere: in a menu, say
  if (keys_[0] != 0 || keys_[1] != 0 || !down_) return;
  down_ = false;
  went_up_ = true;
}

void Button::release_all() {
  *this = Button();
  went_up_ = true;
}

float Button::share() {
  const bool pressed = went_down_, released = went_up_;
  went_down_ = went_up_ = false;
  if (pressed && released) return down_ ? 0.75f : 0.25f;
  if (pressed) return down_ ? 0.5f : 0.0f;
  return down_ && !released ? 1.0f : 0.0f;
}

bool Button::take_press() {
  const bool result = down_ || went_down_;
  went_down_ = false;
  return result;
}

bool runs(const Buttons& buttons, const InputSettings& settings) {
  return buttons.speed.down() != (settings.always_run != 0.0f);
}

void register_input_cvars(con::Console& console) {
#define FB_REGISTER(member, name, initial, archived, help) \
  if (!console.find_cvar(name))                            \
    console.add_cvar(name, con::number_text(initial), help, archived ? con::kCvarArchive : con::kCvarPlain);
  FB_INPUT_CVARS(FB_REGISTER)
#undef FB_REGISTER
}

InputSettings read_input_settings(const con::Console& console) {
  InputSettings settings;
#define FB_READ(member, name, initial, archived, help) settings.member = console.cvar(name).value();
  FB_INPUT_CVARS(FB_READ)
#undef FB_READ
  return settings;
}

bool adjust_angles(Buttons& b, const InputSettings& s, double seconds, vec3& angles) {
  const auto time = static_cast<float>(runs(b, s) ? seconds * static_cast<double>(s.angle_speed_key) : seconds);
  if (!b.strafe.down()) {
    angles.y -= time * s.yaw_speed * b.right.share();
    angles.y += time * s.yaw_speed * b.left.share();
    angles.y = whole_yaw(angles.y);
  }
  if (b.key_look.down()) {
    angles.x -= time * s.pitch_speed * b.forward.share();
    angles.x += time * s.pitch_speed * b.back.share();
  }
  const float up = b.look_up.share(), down = b.look_down.share();
  angles.x -= time * s.pitch_speed * up;
  angles.x += time * s.pitch_speed * down;
  clamp_pitch(s, angles);
  angles.z = std::clamp(angles.z, -kMostRoll, kMostRoll);
  return b.key_look.down() || up != 0.0f || down != 0.0f;
}

bool apply_mouse(const Buttons& b, const InputSettings& s, const vec2& counts, vec3& angles, UserMove& move) {
  const vec2 motion = counts * s.sensitivity;
  const bool look = b.mouse_look.down();
  if (b.strafe.down() || (s.look_strafe != 0.0f && look))
    move.side += s.mouse_side * motion.x;
  else
    angles.y -= s.mouse_yaw * motion.x;
  if (look && !b.strafe.down()) {
    angles.x += s.mouse_pitch * motion.y;
    clamp_pitch(s, angles);
  } else {
    move.forward -= s.mouse_forward * motion.y;
  }
  return look && (motion.x != 0.0f || motion.y != 0.0f);
}

UserMove base_move(Buttons& b, const InputSettings& s) {
  UserMove move;
  if (b.strafe.down()) {
    move.side += s.side_speed * b.right.share();
    move.side -= s.side_speed * b.left.share();
  }
  move.side += s.side_speed * b.move_right.share();
  move.side -= s.side_speed * b.move_left.share();
  move.up += s.up_speed * b.move_up.share();
  move.up -= s.up_speed * b.move_down.share();
  if (!b.key_look.down()) {
    move.forward += s.forward_speed * b.forward.share();
    move.forward -= s.back_speed * b.back.share();
  }
  if (runs(b, s)) {
    move.forward *= s.move_speed_key;
    move.side *= s.move_speed_key;
    move.up *= s.move_speed_key;
  }
  return move;
}

net::clc::Move make_move(Buttons& b, const InputSettings& s, const UserMove& pending, const vec3& view_angles,
                         double message_time) {
  const UserMove keys = base_move(b, s);
  net::clc::Move move;
  move.time = static_cast<float>(message_time);
  move.view_angles = view_angles;
  move.forward = whole_speed(keys.forward + pending.forward);
  move.side = whole_speed(keys.side + pending.side);
  move.up = whole_speed(keys.up + pending.up);
  if (b.attack.take_press()) move.buttons |= 1;
  if (b.jump.take_press()) move.buttons |= 2;
  move.impulse = b.impulse;
  b.impulse = 0;
  return move;
}

void PitchDrift::start(double time, const InputSettings& settings) {
  if (stop_time_ == time) return;
  if (!held_ && speed_ != 0.0f) return;
  speed_ = settings.center_speed;
  held_ = false;
  walked_ = 0.0;
}

void PitchDrift::stop(double time) {
  stop_time_ = time;
  held_ = true;
  speed_ = 0.0f;
}

void PitchDrift::advance(const Moment& now, const InputSettings& s, float& pitch) {
  if (!now.on_ground) {
    walked_ = 0.0;
    speed_ = 0.0f;
    return;
  }
  if (held_) {
    walked_ = std::abs(now.forward) < s.forward_speed ? 0.0 : walked_ + now.seconds;
    if (walked_ > static_cast<double>(s.center_move) && s.look_spring != 0.0f) start(now.time, s);
    return;
  }
  const float left = now.ideal_pitch - pitch;
  if (left == 0.0f) {
    speed_ = 0.0f;
    return;
  }
  const auto seconds = static_cast<float>(now.seconds);
  const float step = seconds * speed_;
  speed_ += seconds * s.center_speed;
  if (step >= std::abs(left)) {
    speed_ = 0.0f;
    pitch = now.ideal_pitch;
  } else {
    pitch += left > 0.0f ? step : -step;
  }
}

}  // namespace fb::cl
