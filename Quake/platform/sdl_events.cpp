#include "platform/sdl_events.h"

#include <cstdlib>

namespace fb::platform {
namespace {

struct Place {
  SDL_Scancode code;
  int key;
};

// Keys other than letters, digits and function keys, which are consecutive.
constexpr Place kPlaces[] = {{SDL_SCANCODE_TAB, kKeyTab},
                             {SDL_SCANCODE_RETURN, kKeyEnter},
                             {SDL_SCANCODE_RETURN2, kKeyEnter},
                             {SDL_SCANCODE_ESCAPE, kKeyEscape},
                             {SDL_SCANCODE_SPACE, kKeySpace},
                             {SDL_SCANCODE_BACKSPACE, kKeyBackspace},
                             {SDL_SCANCODE_0, '0'},
                             {SDL_SCANCODE_MINUS, '-'},
                             {SDL_SCANCODE_EQUALS, '='},
                             {SDL_SCANCODE_LEFTBRACKET, '['},
                             {SDL_SCANCODE_RIGHTBRACKET, ']'},
                             {SDL_SCANCODE_BACKSLASH, '\\'},
                             {SDL_SCANCODE_NONUSHASH, '#'},
                             {SDL_SCANCODE_NONUSBACKSLASH, '\\'},
                             {SDL_SCANCODE_SEMICOLON, ';'},
                             {SDL_SCANCODE_APOSTROPHE, '\''},
                             {SDL_SCANCODE_GRAVE, '`'},
                             {SDL_SCANCODE_COMMA, ','},
                             {SDL_SCANCODE_PERIOD, '.'},
                             {SDL_SCANCODE_SLASH, '/'},
                             {SDL_SCANCODE_INSERT, kKeyInsert},
                             {SDL_SCANCODE_DELETE, kKeyDelete},
                             {SDL_SCANCODE_HOME, kKeyHome},
                             {SDL_SCANCODE_END, kKeyEnd},
                             {SDL_SCANCODE_PAGEUP, kKeyPageUp},
                             {SDL_SCANCODE_PAGEDOWN, kKeyPageDown},
                             {SDL_SCANCODE_UP, kKeyUpArrow},
                             {SDL_SCANCODE_DOWN, kKeyDownArrow},
                             {SDL_SCANCODE_LEFT, kKeyLeftArrow},
                             {SDL_SCANCODE_RIGHT, kKeyRightArrow},
                             {SDL_SCANCODE_NUMLOCKCLEAR, kKeypadNumLock},
                             {SDL_SCANCODE_KP_DIVIDE, kKeypadSlash},
                             {SDL_SCANCODE_KP_MULTIPLY, kKeypadStar},
                             {SDL_SCANCODE_KP_MINUS, kKeypadMinus},
                             {SDL_SCANCODE_KP_PLUS, kKeypadPlus},
                             {SDL_SCANCODE_KP_ENTER, kKeypadEnter},
                             {SDL_SCANCODE_KP_1, kKeypadEnd},
                             {SDL_SCANCODE_KP_2, kKeypadDownArrow},
                             {SDL_SCANCODE_KP_3, kKeypadPageDown},
                             {SDL_SCANCODE_KP_4, kKeypadLeftArrow},
                             {SDL_SCANCODE_KP_5, kKeypad5},
                             {SDL_SCANCODE_KP_6, kKeypadRightArrow},
                             {SDL_SCANCODE_KP_7, kKeypadHome},
                             {SDL_SCANCODE_KP_8, kKeypadUpArrow},
                             {SDL_SCANCODE_KP_9, kKeypadPageUp},
                             {SDL_SCANCODE_KP_0, kKeypadInsert},
                             {SDL_SCANCODE_KP_PERIOD, kKeypadDelete},
                             {SDL_SCANCODE_LSHIFT, kKeyShift},
                             {SDL_SCANCODE_RSHIFT, kKeyShift},
                             {SDL_SCANCODE_LCTRL, kKeyCtrl},
                             {SDL_SCANCODE_RCTRL, kKeyCtrl},
                             {SDL_SCANCODE_LALT, kKeyAlt},
                             {SDL_SCANCODE_RALT, kKeyAlt},
                             {SDL_SCANCODE_LGUI, kKeyCommand},
                             {SDL_SCANCODE_RGUI, kKeyCommand},
                             {SDL_SCANCODE_CAPSLOCK, kKeyCapsLock},
                             {SDL_SCANCODE_SCROLLLOCK, kKeyScrollLock},
                             {SDL_SCANCODE_PRINTSCREEN, kKeyPrintScreen},
                             {SDL_SCANCODE_PAUSE, kKeyPause}};

int key_from_button(Uint8 button) {
  switch (button) {
    case SDL_BUTTON_LEFT:
      return kKeyMouse1;
    case SDL_BUTTON_RIGHT:
      return kKeyMouse2;
    case SDL_BUTTON_MIDDLE:
      return kKeyMouse3;
    case SDL_BUTTON_X1:
      return kKeyMouse4;
    case SDL_BUTTON_X2:
      return kKeyMouse5;
    default:
      return kKeyNone;
  }
}

void add_key(std::vector<InputEvent>& to, int key, bool down, bool repeat = false, char letter = 0) {
  if (key == kKeyNone) return;
  InputEvent event;
  event.kind = InputEvent::Kind::kKey;
  event.key = key;
  event.down = down;
  event.repeat = repeat;
  event.letter = letter;
  to.push_back(event);
}

char letter_of(SDL_Keycode code) { return code > ' ' && code < 0x7f ? static_cast<char>(code) : '\0'; }

void add_window_event(std::vector<InputEvent>& to, const SDL_WindowEvent& from) {
  InputEvent event;
  switch (from.event) {
    case SDL_WINDOWEVENT_FOCUS_GAINED:
    case SDL_WINDOWEVENT_FOCUS_LOST:
      event.kind = InputEvent::Kind::kFocus;
      event.focused = from.event == SDL_WINDOWEVENT_FOCUS_GAINED;
      break;
    case SDL_WINDOWEVENT_RESIZED:  // SIZE_CHANGED comes as well; this one not for a size that the program has asked for
      event.by_user = true;
      [[fallthrough]];
    case SDL_WINDOWEVENT_SIZE_CHANGED:
    case SDL_WINDOWEVENT_MINIMIZED:
    case SDL_WINDOWEVENT_RESTORED:
      event.kind = InputEvent::Kind::kResize;
      break;
    default:  // closing the only window sends SDL_QUIT as well
      return;
  }
  to.push_back(event);
}

}  // namespace

int key_from_scancode(SDL_Scancode code) {
  if (code >= SDL_SCANCODE_A && code <= SDL_SCANCODE_Z) return 'a' + (code - SDL_SCANCODE_A);
  if (code >= SDL_SCANCODE_1 && code <= SDL_SCANCODE_9) return '1' + (code - SDL_SCANCODE_1);
  if (code >= SDL_SCANCODE_F1 && code <= SDL_SCANCODE_F12) return kKeyF1 + (code - SDL_SCANCODE_F1);
  for (const Place& place : kPlaces)
    if (place.code == code) return place.key;
  return kKeyNone;
}

void translate_event(const SDL_Event& event, std::vector<InputEvent>& to) {
  InputEvent made;
  switch (event.type) {
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      add_key(to, key_from_scancode(event.key.keysym.scancode), event.type == SDL_KEYDOWN, event.key.repeat != 0,
              letter_of(event.key.keysym.sym));
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      add_key(to, key_from_button(event.button.button), event.type == SDL_MOUSEBUTTONDOWN);
      break;
    case SDL_MOUSEWHEEL:
      for (int step = 0; step < std::abs(event.wheel.y); ++step) {
        add_key(to, event.wheel.y > 0 ? kKeyWheelUp : kKeyWheelDown, true);
        add_key(to, event.wheel.y > 0 ? kKeyWheelUp : kKeyWheelDown, false);
      }
      break;
    case SDL_MOUSEMOTION:
      made.kind = InputEvent::Kind::kMouseMotion;
      made.dx = event.motion.xrel;
      made.dy = event.motion.yrel;
      made.x = static_cast<float>(event.motion.x);
      made.y = static_cast<float>(event.motion.y);
      to.push_back(made);
      break;
    case SDL_TEXTINPUT:
      made.kind = InputEvent::Kind::kText;
      made.text = event.text.text;
      to.push_back(made);
      break;
    case SDL_WINDOWEVENT:
      add_window_event(to, event.window);
      break;
    case SDL_QUIT:
      made.kind = InputEvent::Kind::kQuit;
      to.push_back(made);
      break;
    default:
      break;
  }
}

}  // namespace fb::platform
