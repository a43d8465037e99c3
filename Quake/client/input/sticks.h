// The sticks of a game controller: what they do to the player's view and move. Cvars and their meaning are
// QuakeSpasm's.
#pragma once

#include "base/maths.h"
#include "client/input/input.h"

namespace fb::cl {

// Where the sticks are: -1 to 1, to the right and downwards.
struct Sticks {
  vec2 left{0.0f}, right{0.0f};
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
  X(swap, "joy_swapmovelook", 0.0f, 0.0f, 1.0f, "1: the left stick looks and the right one moves")

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
// How fast the player wants to go by the move stick. `runs`: by +speed and cl_alwaysrun.
UserMove stick_move(const Sticks& sticks, const StickSettings& settings, const InputSettings& input, bool runs);

}  // namespace fb::cl
