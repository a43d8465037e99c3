// Game controllers by SDL; used by this module only. Buttons and triggers become keys: the cross the arrow keys, start
// Escape and back Tab, as in QuakeSpasm, the others keys of their own.
#pragma once

#include <SDL_events.h>
#include <SDL_gamecontroller.h>

#include <array>
#include <map>
#include <vector>

#include "platform/gamepad.h"
#include "platform/input_event.h"

namespace fb::platform {

// kKeyNone for buttons that Quake has no key for.
int key_from_pad_button(SDL_GameControllerButton button);

class Gamepads {
 public:
  ~Gamepads() { use(false); }
  // Opens the controllers that there are, or closes all.
  void use(bool on);
  // The part of a trigger's way, 0 to 1, from which it is pressed.
  void set_trigger_threshold(float threshold) { threshold_ = threshold; }
  // Notes controllers that come and go and axes that move; appends the keys of buttons and triggers.
  void handle(const SDL_Event& event, std::vector<InputEvent>& to);
  // Begins to count anew what gyroscopes have turned.
  PadSticks take_sticks();
  // Shakes those that can, for so many seconds; `strength` 0 to 1.
  void rumble(float strength, double seconds);

 private:
  struct Pad {
    SDL_GameController* controller = nullptr;
    std::array<float, SDL_CONTROLLER_AXIS_MAX> axes{};
    std::array<bool, 2> triggers{};
    std::uint32_t turning_since = 0;  // SDL's milliseconds of the gyroscope's last word; 0: none yet
  };
  void open(int device);
  void move_axis(const SDL_ControllerAxisEvent& event, std::vector<InputEvent>& to);
  void turn(const SDL_ControllerSensorEvent& event);

  bool on_ = false;
  float threshold_ = 0.2f;
  vec3 turned_{0.0f};  // degrees
  std::map<SDL_JoystickID, Pad> pads_;
};

}  // namespace fb::platform
