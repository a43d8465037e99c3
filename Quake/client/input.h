// What a player's buttons and mouse mean: Quake's kbuttons, and the pure functions that make view angles and clc_move
// of them. Nothing here knows keys, windows or connections; input_commands.cpp gives the buttons their console
// commands.
//
//   each frame:  adjust_angles(buttons, settings, seconds, angles);            // turning by keys
//                apply_mouse(buttons, settings, mouse, angles, pending);       // turning and moving by mouse
//   each tick:   make_move(buttons, settings, pending, angles, message_time);  // what the server is told
#pragma once

#include <array>
#include <string_view>

#include "base/maths.h"
#include "net/client_messages.h"

namespace fb::con {
class Console;
}

namespace fb::cl {

// A button that up to two keys hold down. It remembers whether it went down or up since it was asked last, so that a
// tap shorter than a frame counts.
class Button {
 public:
  static constexpr int kTyped = -1;  // pressed by a command without a key's number

  // False, and nothing happens, when two other keys hold it already. A key that holds it is a repeat.
  bool press(int key);
  void release(int key);
  // What "-name" without a key does: lets go whoever holds it, and forgets that it was pressed.
  void release_all();

  bool down() const { return down_; }
  // Which share of the time since the last call it was down, as Quake estimates it (CL_KeyState): 1 all the time, 0.5
  // it went down, 0.25 down and up again, 0.75 up and down again, 0 it went up or was up.
  float share();
  // Is it down, or was it since the last call? Forgets the latter.
  bool take_press();

 private:
  std::array<int, 2> keys_{};  // 0: none
  bool down_ = false, went_down_ = false, went_up_ = false;
};

// One row a button: member, the name behind + and -, what it does while it is down.
#define FB_BUTTONS(X)                                                                \
  X(move_up, "moveup", "swims up")                                                   \
  X(move_down, "movedown", "swims down")                                             \
  X(left, "left", "turns left")                                                      \
  X(right, "right", "turns right")                                                   \
  X(forward, "forward", "walks forward")                                             \
  X(back, "back", "walks back")                                                      \
  X(look_up, "lookup", "looks up")                                                   \
  X(look_down, "lookdown", "looks down")                                             \
  X(strafe, "strafe", "makes steps to the side of turns, and of the mouse's motion") \
  X(move_left, "moveleft", "steps to the left")                                      \
  X(move_right, "moveright", "steps to the right")                                   \
  X(speed, "speed", "runs; walks with cl_alwaysrun")                                 \
  X(attack, "attack", "fires")                                                       \
  X(use, "use", "nothing in Quake: servers are not told")                            \
  X(jump, "jump", "jumps, swims up")                                                 \
  X(key_look, "klook", "the keys of walking look up and down")                       \
  X(mouse_look, "mlook", "the mouse looks up and down")

struct Buttons {
#define FB_BUTTON(member, name, help) Button member;
  FB_BUTTONS(FB_BUTTON)
#undef FB_BUTTON
  int impulse = 0;  // sent once, 0 to 255
};

// One row a cvar: member, name, default, archived, help. Names and defaults are QuakeSpasm's.
#define FB_INPUT_CVARS(X)                                                                                     \
  X(up_speed, "cl_upspeed", 200.0f, false, "speed of swimming up and down, units a second")                   \
  X(forward_speed, "cl_forwardspeed", 200.0f, true, "speed of +forward")                                      \
  X(back_speed, "cl_backspeed", 200.0f, true, "speed of +back")                                               \
  X(side_speed, "cl_sidespeed", 350.0f, false, "speed of +moveleft and +moveright")                           \
  X(move_speed_key, "cl_movespeedkey", 2.0f, false, "+speed makes moves so many times as fast")               \
  X(yaw_speed, "cl_yawspeed", 140.0f, false, "speed of +left and +right, degrees a second")                   \
  X(pitch_speed, "cl_pitchspeed", 150.0f, false, "speed of +lookup and +lookdown")                            \
  X(angle_speed_key, "cl_anglespeedkey", 1.5f, false, "+speed makes turns so many times as fast")             \
  X(always_run, "cl_alwaysrun", 0.0f, true, "runs, and +speed walks")                                         \
  X(max_pitch, "cl_maxpitch", 90.0f, true, "how far one may look down, degrees")                              \
  X(min_pitch, "cl_minpitch", -90.0f, true, "how far one may look up, degrees")                               \
  X(look_spring, "lookspring", 0.0f, true, "the view springs back level when one walks or lets go of +mlook") \
  X(look_strafe, "lookstrafe", 0.0f, true, "with +mlook the mouse's sideways motion walks sideways")          \
  X(sensitivity, "sensitivity", 3.0f, true, "how strong the mouse's motion counts")                           \
  X(mouse_pitch, "m_pitch", 0.022f, true, "degrees up and down of a count of the mouse; negative: inverted")  \
  X(mouse_yaw, "m_yaw", 0.022f, true, "degrees left and right of a count")                                    \
  X(mouse_forward, "m_forward", 1.0f, true, "speed forward of a count, where the mouse walks")                \
  X(mouse_side, "m_side", 0.8f, true, "speed sideways of a count")                                            \
  X(mouse_filter, "m_filter", 0.0f, true, "averages the mouse's motion over two frames")                      \
  X(center_move, "v_centermove", 0.15f, false, "seconds of walking until lookspring levels the view")         \
  X(center_speed, "v_centerspeed", 500.0f, false, "how fast the view levels: degrees a second, each second")

struct InputSettings {
#define FB_MEMBER(member, name, initial, archived, help) float member = initial;
  FB_INPUT_CVARS(FB_MEMBER)
#undef FB_MEMBER
};
void register_input_cvars(con::Console& console);
InputSettings read_input_settings(const con::Console& console);

// How fast the player wants to go: units a second along the view's axes.
struct UserMove {
  float forward = 0.0f, side = 0.0f, up = 0.0f;
};

// Turns the view by the keys held over `seconds` (CL_AdjustAngles). True if keys changed the pitch, which ends its
// drift.
bool adjust_angles(Buttons& buttons, const InputSettings& settings, double seconds, vec3& view_angles);

// Turns the view and adds to the move what the mouse did: counts to the right and downwards. True if it looked up or
// down.
bool apply_mouse(const Buttons& buttons, const InputSettings& settings, const vec2& counts, vec3& view_angles,
                 UserMove& move);

// What the keys held since the last call amount to (CL_BaseMove).
UserMove base_move(Buttons& buttons, const InputSettings& settings);

// What the server is told: the keys' move plus `pending` from the mouse, cut to what the message holds. Takes presses
// and the impulse off the buttons.
net::clc::Move make_move(Buttons& buttons, const InputSettings& settings, const UserMove& pending,
                         const vec3& view_angles, double message_time);

// The view's way back to level (V_DriftPitch), while nobody steers it: to the slope of the ground that the server
// names.
class PitchDrift {
 public:
  // centerview, and letting go of +mlook with lookspring: starts unless somebody steered at this very time.
  void start(double time, const InputSettings& settings);
  // Somebody steers.
  void stop(double time);
  void forget() { *this = PitchDrift(); }

  struct Moment {
    double seconds = 0.0, time = 0.0;
    bool on_ground = false;
    float forward = 0.0f;  // of the last move
    float ideal_pitch = 0.0f;
  };
  void advance(const Moment& moment, const InputSettings& settings, float& pitch);

 private:
  bool held_ = false;  // steered: only lookspring or centerview start it again
  float speed_ = 0.0f;
  double walked_ = 0.0, stop_time_ = 0.0;
};

}  // namespace fb::cl
