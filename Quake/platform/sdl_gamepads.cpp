#include "platform/sdl_gamepads.h"

#ifndef SDL_MAIN_HANDLED
#define SDL_MAIN_HANDLED
#endif
#include <SDL.h>

#include <algorithm>
#include <utility>

#include "base/log.h"

namespace fb::platform {
namespace {

constexpr float kRelease = 0.75f;            // of the threshold: a trigger at its edge must not flutter
constexpr std::uint32_t kLongestTurn = 100;  // milliseconds between two words of a gyroscope that belong together

void add_pad_key(std::vector<InputEvent>& to, int key, bool down) {
  if (key == kKeyNone) return;
  InputEvent event;
  event.kind = InputEvent::Kind::kKey;
  event.key = key;
  event.down = down;
  to.push_back(event);
}

vec2 larger(const vec2& a, const vec2& b) { return glm::dot(a, a) < glm::dot(b, b) ? b : a; }

}  // namespace

int key_from_pad_button(SDL_GameControllerButton button) {
  switch (button) {
    case SDL_CONTROLLER_BUTTON_A:
      return kKeyAButton;
    case SDL_CONTROLLER_BUTTON_B:
      return kKeyBButton;
    case SDL_CONTROLLER_BUTTON_X:
      return kKeyXButton;
    case SDL_CONTROLLER_BUTTON_Y:
      return kKeyYButton;
    case SDL_CONTROLLER_BUTTON_BACK:
      return kKeyTab;
    case SDL_CONTROLLER_BUTTON_START:
      return kKeyEscape;
    case SDL_CONTROLLER_BUTTON_LEFTSTICK:
      return kKeyLeftThumb;
    case SDL_CONTROLLER_BUTTON_RIGHTSTICK:
      return kKeyRightThumb;
    case SDL_CONTROLLER_BUTTON_LEFTSHOULDER:
      return kKeyLeftShoulder;
    case SDL_CONTROLLER_BUTTON_RIGHTSHOULDER:
      return kKeyRightShoulder;
    case SDL_CONTROLLER_BUTTON_DPAD_UP:
      return kKeyDpadUp;
    case SDL_CONTROLLER_BUTTON_DPAD_DOWN:
      return kKeyDpadDown;
    case SDL_CONTROLLER_BUTTON_DPAD_LEFT:
      return kKeyDpadLeft;
    case SDL_CONTROLLER_BUTTON_DPAD_RIGHT:
      return kKeyDpadRight;
    case SDL_CONTROLLER_BUTTON_GUIDE:
      return kKeyGuide;
    case SDL_CONTROLLER_BUTTON_MISC1:
      return kKeyMisc1;
    case SDL_CONTROLLER_BUTTON_PADDLE1:
      return kKeyPaddle1;
    case SDL_CONTROLLER_BUTTON_PADDLE2:
      return kKeyPaddle2;
    case SDL_CONTROLLER_BUTTON_PADDLE3:
      return kKeyPaddle3;
    case SDL_CONTROLLER_BUTTON_PADDLE4:
      return kKeyPaddle4;
    case SDL_CONTROLLER_BUTTON_TOUCHPAD:
      return kKeyTouchpad;
    default:
      return kKeyNone;
  }
}

void Gamepads::use(bool on) {
  if (on == on_) return;
  on_ = on;
  if (on) {
    if (SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER) != 0) {
      log_warning("game controllers cannot be used ({})", SDL_GetError());
      on_ = false;
    }
    return;  // SDL tells of each that is there by an event
  }
  for (auto& [id, pad] : pads_) SDL_GameControllerClose(pad.controller);
  pads_.clear();
  SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
}

void Gamepads::open(int device) {
  SDL_GameController* controller = SDL_GameControllerOpen(device);
  if (controller == nullptr) return log_warning("a game controller cannot be used ({})", SDL_GetError());
  const SDL_JoystickID id = SDL_JoystickInstanceID(SDL_GameControllerGetJoystick(controller));
  if (pads_.contains(id)) return SDL_GameControllerClose(controller);  // it was told of twice
  pads_[id].controller = controller;
  if (SDL_GameControllerHasSensor(controller, SDL_SENSOR_GYRO))
    SDL_GameControllerSetSensorEnabled(controller, SDL_SENSOR_GYRO, SDL_TRUE);
  const char* name = SDL_GameControllerName(controller);
  log_info("game controller: {}", name != nullptr ? name : "without a name");
}

void Gamepads::move_axis(const SDL_ControllerAxisEvent& event, std::vector<InputEvent>& to) {
  const auto pad = pads_.find(event.which);
  if (pad == pads_.end() || event.axis >= SDL_CONTROLLER_AXIS_MAX) return;
  const float value = std::max(static_cast<float>(event.value) / 32767.0f, -1.0f);
  pad->second.axes[event.axis] = value;
  const bool left = event.axis == SDL_CONTROLLER_AXIS_TRIGGERLEFT;
  if (!left && event.axis != SDL_CONTROLLER_AXIS_TRIGGERRIGHT) return;
  bool& down = pad->second.triggers[left ? 0 : 1];
  const bool now = value > (down ? kRelease * threshold_ : threshold_);
  if (now != down) add_pad_key(to, left ? kKeyLeftTrigger : kKeyRightTrigger, now);
  down = now;
}

void Gamepads::handle(const SDL_Event& event, std::vector<InputEvent>& to) {
  if (!on_) return;
  switch (event.type) {
    case SDL_CONTROLLERDEVICEADDED:
      open(event.cdevice.which);
      break;
    case SDL_CONTROLLERDEVICEREMOVED:
      if (const auto pad = pads_.find(event.cdevice.which); pad != pads_.end()) {
        SDL_GameControllerClose(pad->second.controller);
        pads_.erase(pad);
        log_info("a game controller is gone");
      }
      break;
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
      add_pad_key(to, key_from_pad_button(static_cast<SDL_GameControllerButton>(event.cbutton.button)),
                  event.type == SDL_CONTROLLERBUTTONDOWN);
      break;
    case SDL_CONTROLLERAXISMOTION:
      move_axis(event.caxis, to);
      break;
    case SDL_CONTROLLERSENSORUPDATE:
      turn(event.csensor);
      break;
    default:
      break;
  }
}

// Radians a second about the axes to the right, upwards and towards the player, counter-clockwise as seen from there.
void Gamepads::turn(const SDL_ControllerSensorEvent& event) {
  const auto pad = pads_.find(event.which);
  if (pad == pads_.end() || event.sensor != SDL_SENSOR_GYRO) return;
  const std::uint32_t since = std::exchange(pad->second.turning_since, event.timestamp);
  const std::uint32_t elapsed = event.timestamp - since;
  if (since == 0 || elapsed > kLongestTurn) return;
  turned_ += degrees(1.0f) * vec3(event.data[0], event.data[1], event.data[2]) * (1e-3f * static_cast<float>(elapsed));
}

void Gamepads::rumble(float strength, double seconds) {
  const auto power = static_cast<Uint16>(65535.0f * std::clamp(strength, 0.0f, 1.0f));
  for (auto& [id, pad] : pads_)
    SDL_GameControllerRumble(pad.controller, power, power, static_cast<Uint32>(1000.0 * seconds));
}

PadSticks Gamepads::take_sticks() {
  PadSticks sticks;
  sticks.turned = std::exchange(turned_, vec3(0.0f));
  for (const auto& [id, pad] : pads_) {
    sticks.left = larger(sticks.left, vec2(pad.axes[SDL_CONTROLLER_AXIS_LEFTX], pad.axes[SDL_CONTROLLER_AXIS_LEFTY]));
    sticks.right =
        larger(sticks.right, vec2(pad.axes[SDL_CONTROLLER_AXIS_RIGHTX], pad.axes[SDL_CONTROLLER_AXIS_RIGHTY]));
  }
  return sticks;
}

}  // namespace fb::platform
