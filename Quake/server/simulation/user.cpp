#include "server/simulation/user.h"

#include <array>
#include <cmath>

#include "server/simulation/float_vectors.h"
#include "server/simulation/link.h"
#include "server/simulation/quakec.h"
#include "server/simulation/skin_contents.h"

namespace fb::sv {
namespace {

constexpr float kAirSpeed = 30.0f;  // units a second: what in the air is asked for counts for no more
constexpr double kTwoPi = 3.14159265358979323846 * 2.0;
constexpr int kPitch = 0, kYaw = 1, kRoll = 2;

// V_CalcRoll: how much a body leans that moves sideways, degrees.
float calc_roll(const Level& level, const vec3& angles, const vec3& velocity) {
  const float side = dot(velocity, angle_vectors(angles).right);
  const float angle = level.cvars.roll_angle.value(), speed = level.cvars.roll_speed.value();
  const float size = std::fabs(side);
  const float roll = size < speed ? size * angle / speed : angle;
  return side < 0.0f ? -roll : roll;
}

// DropPunchAngle: the view comes back from a kick by ten degrees a second.
void drop_punch_angle(const Level& level, Edict player) {
  vec3 punch = player.get(fields::punchangle);
  auto size = static_cast<float>(normalize(punch) - 10.0 * level.frame_time);
  if (size < 0.0f) size = 0.0f;
  player.set(fields::punchangle, punch * size);
}

// One player's wish for one frame; works on its velocity.
class UserMove {
 public:
  UserMove(Level& level, Edict player, const UserCommand& command)
      : level_(level), player_(player), command_(command), velocity_(player.get(fields::velocity)) {}

  void run() {
    drop_punch_angle(level_, player_);
    if (player_.get(fields::health) <= 0.0f) return;
    turn_body();
    const bool no_clip = enum_of(player_, fields::movetype) == kMoveNoClip;
    if (player_.has_flag(fields::flags, kFlagWaterJump)) {
      water_jump();
    } else if (no_clip && level_.cvars.alt_noclip.on()) {
      no_clip_move();
    } else if (!no_clip && player_.get(fields::waterlevel) >= 2.0f) {
      water_move();
    } else if (enum_of(player_, fields::movetype) == kMoveWalk && on_ladder(level_, player_.id())) {
      ladder_move();
    } else {
      air_move();
    }
    player_.set(fields::velocity, velocity_);
  }

 private:
  // What others see of the player: a third of its pitch, and four times the lean.
  void turn_body() {
    vec3 angles = player_.get(fields::angles);
    const vec3 view = player_.get(fields::v_angle) + player_.get(fields::punchangle);
    angles[kRoll] = calc_roll(level_, angles, velocity_) * 4.0f;
    if (player_.get(fields::fixangle) == 0.0f) {
      angles[kPitch] = -view[kPitch] / 3.0f;
      angles[kYaw] = view[kYaw];
    }
    player_.set(fields::angles, angles);
  }

  // SV_WaterJump: on the way out of the water, until dry or the time is over.
  void water_jump() {
    if (level_.time > player_.get(fields::teleport_time) || player_.get(fields::waterlevel) == 0.0f) {
      player_.remove_flag(fields::flags, kFlagWaterJump);
      player_.set(fields::teleport_time, 0.0f);
    }
    const vec3 direction = player_.get(fields::movedir);
    velocity_.x = direction.x;
    velocity_.y = direction.y;
  }

  // Where one looks and to the side, as fast as is asked for.
  vec3 wish_along(const AxisVectors& axes) const {
    return axes.forward * command_.forward_move + axes.right * command_.side_move;
  }
  AxisVectors view_axes() const { return angle_vectors(player_.get(fields::v_angle)); }
  float max_speed() const { return level_.cvars.max_speed.value(); }

  // SV_NoclipMove of sv_altnoclip: up and down count twice, to be as fast as running.
  void no_clip_move() {
    velocity_ = wish_along(view_axes());
    velocity_.z += command_.up_move * 2.0f;
    if (length(velocity_) > max_speed()) {
      normalize(velocity_);
      velocity_ *= max_speed();
    }
  }

  // SV_WaterMove: who asks for nothing sinks.
  void water_move() {
    vec3 wish = wish_along(view_axes());
    const bool nothing = command_.forward_move == 0.0f && command_.side_move == 0.0f && command_.up_move == 0.0f;
    wish.z += nothing ? -60.0f : command_.up_move;
    float wish_speed = length(wish);
    if (wish_speed > max_speed()) {
      wish *= max_speed() / wish_speed;
      wish_speed = max_speed();
    }
    wish_speed = static_cast<float>(wish_speed * 0.7);

    const float speed = length(velocity_);
    float new_speed = 0.0f;
    if (speed != 0.0f) {
      new_speed = static_cast<float>(speed - level_.frame_time * speed * level_.cvars.friction.value());
      if (new_speed < 0.0f) new_speed = 0.0f;
      velocity_ *= new_speed / speed;
    }
    if (wish_speed == 0.0f) return;
    const float missing = wish_speed - new_speed;
    if (missing <= 0.0f) return;
    normalize(wish);
    const float gain = level_.cvars.accelerate.value() * wish_speed;
    speed_up(wish, static_cast<float>(gain * level_.frame_time), missing);
  }

  // Nothing pulls down, and going forward is climbing: up, unless one looks well below the horizon. Half as fast as on
  // foot; who asks for nothing hangs on.
  void ladder_move() {
    constexpr float kLookDown = 15.0f;  // degrees
    velocity_ = wish_along(view_axes());
    const bool down = player_.get(fields::v_angle)[kPitch] > kLookDown;
    velocity_.z = (down ? -command_.forward_move : command_.forward_move) + command_.up_move;
    if (player_.get(fields::button2) != 0.0f) velocity_.z = max_speed();
    const float most = max_speed() * 0.5f, speed = length(velocity_);
    if (speed > most) velocity_ *= most / speed;
  }

  // SV_AirMove: on foot, falling, and flying. Its axes are the body's, which look up or down by a third and lean.
  void air_move() {
    float forward = command_.forward_move;
    if (level_.time < player_.get(fields::teleport_time) && forward < 0.0f) forward = 0.0f;  // not back through it
    const AxisVectors axes = angle_vectors(player_.get(fields::angles));
    const int movetype = enum_of(player_, fields::movetype);
    vec3 wish = axes.forward * forward + axes.right * command_.side_move;
    wish.z = movetype != kMoveWalk ? command_.up_move : 0.0f;

    vec3 direction = wish;
    float wish_speed = normalize(direction);
    if (wish_speed > max_speed()) {
      wish *= max_speed() / wish_speed;
      wish_speed = max_speed();
    }
    if (movetype == kMoveNoClip) {
      velocity_ = wish;
    } else if (player_.has_flag(fields::flags, kFlagOnGround)) {
      user_friction();
      accelerate(wish_speed, direction);
    } else {
      air_accelerate(wish_speed, wish);
    }
  }

  // SV_UserFriction: more of it where 16 units ahead the ground is more than 34 units below the feet.
  void user_friction() {
    const float speed = std::sqrt(velocity_.x * velocity_.x + velocity_.y * velocity_.y);
    if (speed == 0.0f) return;
    const vec3 origin = player_.get(fields::origin);
    world::Move ahead;
    ahead.start = {origin.x + velocity_.x / speed * 16.0f, origin.y + velocity_.y / speed * 16.0f,
                   origin.z + player_.get(fields::mins).z};
    ahead.end = ahead.start - vec3(0.0f, 0.0f, 34.0f);
    const MoveTrace ground = sv_move(level_, ahead, MoveKind::kNoMonsters, player_.id());
    float friction = level_.cvars.friction.value();
    if (ground.fraction == 1.0f) friction *= level_.cvars.edge_friction.value();

    const float stop_speed = level_.cvars.stop_speed.value();
    const float control = speed < stop_speed ? stop_speed : speed;
    auto new_speed = static_cast<float>(speed - level_.frame_time * control * friction);
    if (new_speed < 0.0f) new_speed = 0.0f;
    velocity_ *= new_speed / speed;
  }

  // SV_Accelerate: only what is missing of the speed in that direction, so that turning keeps what there is.
  void accelerate(float wish_speed, const vec3& direction) {
    const float missing = wish_speed - dot(velocity_, direction);
    if (missing <= 0.0f) return;
    const double gain = level_.cvars.accelerate.value() * level_.frame_time * wish_speed;
    speed_up(direction, static_cast<float>(gain), missing);
  }

  // SV_AirAccelerate: the wish counts for little, but its gain is that of the whole speed: what strafing in the air
  // makes players fast by.
  void air_accelerate(float wish_speed, vec3 wish) {
    float counted = normalize(wish);
    if (counted > kAirSpeed) counted = kAirSpeed;
    const float missing = counted - dot(velocity_, wish);
    if (missing <= 0.0f) return;
    const float gain = level_.cvars.accelerate.value() * wish_speed;
    speed_up(wish, static_cast<float>(gain * level_.frame_time), missing);
  }

  void speed_up(const vec3& direction, float gain, float at_most) {
    velocity_ += (gain > at_most ? at_most : gain) * direction;
  }

  Level& level_;
  Edict player_;
  const UserCommand& command_;
  vec3 velocity_;
};

}  // namespace

void client_think(Level& level, EdictId id, const UserCommand& command) {
  const Edict player = level.edict(id);
  if (enum_of(player, fields::movetype) == kMoveNone) return;
  UserMove(level, player, command).run();
}

// Looks at the ground at six places ahead: where it goes up or down evenly, that is the pitch.
void set_ideal_pitch(Level& level, EdictId id) {
  constexpr int kPlaces = 6;
  constexpr double kEven = 0.1;  // units
  Edict player = level.edict(id);
  if (!player.has_flag(fields::flags, kFlagOnGround)) return;
  const auto yaw = static_cast<float>(player.get(fields::angles)[kYaw] * kTwoPi / 360.0);
  const auto sine = static_cast<float>(std::sin(static_cast<double>(yaw)));
  const auto cosine = static_cast<float>(std::cos(static_cast<double>(yaw)));
  const vec3 origin = player.get(fields::origin);
  std::array<float, kPlaces> heights;
  for (int i = 0; i < kPlaces; ++i) {
    const auto way = static_cast<float>((i + 3) * 12);
    world::Move look;
    look.start = {origin.x + cosine * way, origin.y + sine * way, origin.z + player.get(fields::view_ofs).z};
    look.end = look.start - vec3(0.0f, 0.0f, 160.0f);
    const MoveTrace ground = sv_move(level, look, MoveKind::kNoMonsters, id);
    if (ground.all_solid || ground.fraction == 1.0f) return;  // a wall, or a drop: stays as it was
    heights[static_cast<std::size_t>(i)] = look.start.z + ground.fraction * (look.end.z - look.start.z);
  }
  float slope = 0.0f;
  int steps = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const float step = heights[i] - heights[i - 1];
    if (std::fabs(static_cast<double>(step)) < kEven) continue;
    if (slope != 0.0f && std::fabs(static_cast<double>(step - slope)) > kEven) return;  // not the same all the way
    ++steps;
    slope = step;
  }
  if (slope == 0.0f) {
    player.set(fields::idealpitch, 0.0f);
  } else if (steps >= 2) {
    player.set(fields::idealpitch, -slope * level.cvars.ideal_pitch_scale.value());
  }
}

}  // namespace fb::sv
