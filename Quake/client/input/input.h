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
#define FB_BUTTONS(X)                                                           \
  X(move_up, "moveup", "swim up")                                               \
  X(move_down, "movedown", "swim down")                                         \
  X(left, "left", "turn left")                                                  \
  X(right, "right", "turn right")                                               \
  X(forward, "forward", "walk forward")                                         \
  X(back, "back", "walk back")                                                  \
  X(look_up, "lookup", "look up")                                               \
  X(look_down, "lookdown", "look down")                                         \
  X(strafe, "strafe", "step sideways instead of turning, by keys and by mouse") \
  X(move_left, "moveleft", "step to the left")                                  \
  X(move_right, "moveright", "step to the right")                               \
  X(speed, "speed", "run; with cl_alwaysrun, walk")                             \
  X(attack, "attack", "fire")                                                   \
  X(use, "use", "no effect: Quake's protocol has no bit for it")                \
  X(jump, "jump", "jump, swim up")                                              \
  X(key_look, "klook", "look up and down by +forward and +back")                \
  X(mouse_look, "mlook", "look up and down by the mouse")                       \
  X(gyro_action, "gyroaction", "let a controller's gyroscope turn the view, or keep it from that (gyro_mode)")

struct Buttons {
#define FB_BUTTON(member, name, help) Button member;
  FB_BUTTONS(FB_BUTTON)
#undef FB_BUTTON
  int impulse = 0;  // sent once, 0 to 255
};

// One row a cvar: member, name, default, archived, help. Names and defaults are QuakeSpasm's.
#define FB_INPUT_CVARS(X)                                                                                           \
  X(up_speed, "cl_upspeed", 200.0f, false, "speed of +moveup and +movedown, units a second")                        \
  X(forward_speed, "cl_forwardspeed", 200.0f, true, "speed of +forward, units a second")                            \
  X(back_speed, "cl_backspeed", 200.0f, true, "speed of +back, units a second")                                     \
  X(side_speed, "cl_sidespeed", 350.0f, false, "speed of +moveleft and +moveright, units a second")                 \
  X(move_speed_key, "cl_movespeedkey", 2.0f, false, "factor of +speed on walking")                                  \
  X(yaw_speed, "cl_yawspeed", 140.0f, false, "speed of +left and +right, degrees a second")                         \
  X(pitch_speed, "cl_pitchspeed", 150.0f, false, "speed of +lookup and +lookdown, degrees a second")                \
  X(angle_speed_key, "cl_anglespeedkey", 1.5f, false, "factor of +speed on turning")                                \
  X(always_run, "cl_alwaysrun", 0.0f, true, "1: run by default, and +speed walks")                                  \
  X(max_pitch, "cl_maxpitch", 90.0f, true, "largest pitch (down), degrees")                                         \
  X(min_pitch, "cl_minpitch", -90.0f, true, "smallest pitch (up), degrees")                                         \
  X(look_spring, "lookspring", 0.0f, true, "1: the view returns to level when walking or releasing +mlook")         \
  X(look_strafe, "lookstrafe", 0.0f, true, "1: with +mlook, sideways mouse motion steps sideways")                  \
  X(sensitivity, "sensitivity", 3.0f, true, "mouse sensitivity: factor on its motion")                              \
  X(mouse_pitch, "m_pitch", 0.022f, true, "pitch for each mouse count, degrees; negative inverts")                  \
  X(mouse_yaw, "m_yaw", 0.022f, true, "yaw for each mouse count, degrees")                                          \
  X(mouse_forward, "m_forward", 1.0f, true, "forward speed for each mouse count, where the mouse moves the player") \
  X(mouse_side, "m_side", 0.8f, true, "sideways speed for each mouse count, likewise")                              \
  X(mouse_filter, "m_filter", 0.0f, true, "1: average the mouse's motion over two frames")                          \
  X(center_move, "v_centermove", 0.15f, false, "seconds of walking after which lookspring levels the view")         \
  X(center_speed, "v_centerspeed", 500.0f, false,                                                                   \
    "acceleration of the view's return to level, degrees per second squared")

struct InputSettings {
#define FB_MEMBER(member, name, initial, archived, help) float member = initial;
  FB_INPUT_CVARS(FB_MEMBER)
#undef FB_MEMBER
};
void register_input_cvars(con::Console& console);
InputSettings read_input_settings(const con::Console& console);

// Whether the player runs: by +speed and cl_alwaysrun.
bool runs(const Buttons& buttons, const InputSettings& settings);

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
