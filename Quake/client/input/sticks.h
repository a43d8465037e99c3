// The sticks and the gyroscope of a game controller: what they do to the player's view and move. Cvars and their
// meaning are QuakeSpasm's.
#pragma once

#include "base/maths.h"
#include "client/input/input.h"

namespace fb::cl {

// Where the sticks are: -1 to 1, to the right and downwards; and how far the controller was turned in this frame,
// degrees: up, to the left, over to the left.
struct Sticks {
  vec2 left{0.0f}, right{0.0f};
  vec3 turned{0.0f};
};

// One row a cvar: member, name, default, least, most, help.
#define FB_STICK_CVARS(X)                                                                                           \
  X(enable, "joy_enable", 1.0f, 0.0f, 1.0f, "1: use game controllers")                                              \
  X(dead_look, "joy_deadzone_look", 0.175f, 0.0f, 0.9f, "dead zone of the look stick")                              \
  X(dead_move, "joy_deadzone_move", 0.175f, 0.0f, 0.9f, "dead zone of the move stick")                              \
  X(dead_trigger, "joy_deadzone_trigger", 0.2f, 0.0f, 0.9f, "how far a trigger moves before it is pressed")         \
  X(outer_look, "joy_outer_threshold_look", 0.02f, 0.0f, 0.5f, "outer dead zone of the look stick")                 \
  X(outer_move, "joy_outer_threshold_move", 0.02f, 0.0f, 0.5f, "outer dead zone of the move stick")                 \
  X(exponent_look, "joy_exponent", 2.0f, 0.5f, 8.0f, "response exponent of the look stick")                         \
  X(exponent_move, "joy_exponent_move", 2.0f, 0.5f, 8.0f, "response exponent of the move stick")                    \
  X(pitch_speed, "joy_sensitivity_pitch", 130.0f, 0.0f, 1000.0f, "pitch speed of the look stick, degrees a second") \
  X(yaw_speed, "joy_sensitivity_yaw", 240.0f, 0.0f, 1000.0f, "yaw speed of the look stick, degrees a second")       \
  X(invert, "joy_invert", 0.0f, 0.0f, 1.0f, "1: invert the look stick's pitch")                                     \
  X(swap, "joy_swapmovelook", 0.0f, 0.0f, 1.0f, "1: the left stick looks and the right one moves")                  \
  X(rumble, "joy_rumble", 0.3f, 0.0f, 1.0f, "how hard controllers shake from damage and recoil; 0: not")            \
  X(gyro, "gyro_enable", 1.0f, 0.0f, 1.0f, "1: turning a controller that has a gyroscope turns the view")           \
  X(gyro_mode, "gyro_mode", 2.0f, 0.0f, 2.0f,                                                                       \
    "what +gyroaction does: 0 nothing, 1 the gyroscope counts while it is held, 2 it counts but while it is held")  \
  X(gyro_axis, "gyro_turning_axis", 0.0f, 0.0f, 1.0f, "turns by: 0 yaw, 1 roll of the controller")                  \
  X(gyro_yaw, "gyro_yawsensitivity", 2.5f, 0.0f, 100.0f, "degrees of yaw for one of the controller's")              \
  X(gyro_pitch, "gyro_pitchsensitivity", 2.5f, 0.0f, 100.0f, "degrees of pitch for one of the controller's")        \
  X(gyro_noise, "gyro_noise_thresh", 1.5f, 0.0f, 50.0f, "degrees a second below which the gyroscope's word is noise")

struct StickSettings {
#define FB_MEMBER(member, name, initial, least, most, help) float member = initial;
  FB_STICK_CVARS(FB_MEMBER)
#undef FB_MEMBER
};
void register_stick_cvars(con::Console& console);
StickSettings read_stick_settings(const con::Console& console);

// A stick's deflection, 0 to 1 long: nothing inside the dead zone, all from the outer threshold on, and in between by
// the exponent. The direction stays.
vec2 shape_stick(const vec2& stick, float dead, float outer, float exponent);

// Turns the view over `seconds`. True if the stick looked up or down.
bool apply_look_stick(const Sticks& sticks, const StickSettings& settings, const InputSettings& input, double seconds,
                      vec3& view_angles);
// Turns the view as the controller was turned in `seconds`; `action`: +gyroaction is down. True if it looked up or
// down.
bool apply_gyro(const Sticks& sticks, const StickSettings& settings, const InputSettings& input, bool action,
                double seconds, vec3& view_angles);
// How fast the player wants to go by the move stick. `runs`: by +speed and cl_alwaysrun.
UserMove stick_move(const Sticks& sticks, const StickSettings& settings, const InputSettings& input, bool runs);

}  // namespace fb::cl
