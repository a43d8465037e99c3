// Keys by the numbers and names of Quake and its configuration files. A key that prints has the number of its
// lower-case character on a US keyboard, whatever the layout: the position of a key counts, as in QuakeSpasm. Mouse
// buttons and the wheel's steps are keys, too.
#pragma once

#include <string>
#include <string_view>

namespace fb::platform {

enum Key : int {
  kKeyNone = 0,
  kKeyTab = 9,
  kKeyEnter = 13,
  kKeyEscape = 27,
  kKeySpace = 32,
  kKeyBackspace = 127,
  kKeyUpArrow = 128,
  kKeyDownArrow,
  kKeyLeftArrow,
  kKeyRightArrow,
  kKeyAlt,
  kKeyCtrl,
  kKeyShift,
  kKeyF1,
  kKeyF12 = kKeyF1 + 11,
  kKeyInsert,
  kKeyDelete,
  kKeyPageDown,
  kKeyPageUp,
  kKeyHome,
  kKeyEnd,
  kKeypadNumLock,
  kKeypadSlash,
  kKeypadStar,
  kKeypadMinus,
  kKeypadHome,
  kKeypadUpArrow,
  kKeypadPageUp,
  kKeypadPlus,
  kKeypadLeftArrow,
  kKeypad5,
  kKeypadRightArrow,
  kKeypadEnd,
  kKeypadDownArrow,
  kKeypadPageDown,
  kKeypadEnter,
  kKeypadInsert,
  kKeypadDelete,
  kKeyCommand,
  kKeyCapsLock,  // Ironwail's number, as the next
  kKeyScrollLock,
  kKeyMouse1 = 200,  // left
  kKeyMouse2,        // right
  kKeyMouse3,        // middle
  // Joysticks that are no game controllers have only names, so that configurations keep their bindings.
  kKeyJoy1 = 203,  // to JOY4
  kKeyAux1 = 207,  // to AUX32
  kKeyWheelUp = 239,
  kKeyWheelDown,
  kKeyMouse4,
  kKeyMouse5,
  kKeyLeftThumb,
  kKeyRightThumb,
  kKeyLeftShoulder,
  kKeyRightShoulder,
  kKeyAButton,
  kKeyBButton,
  kKeyXButton,
  kKeyYButton,
  kKeyLeftTrigger,
  kKeyRightTrigger,
  kKeyPrintScreen = 254,
  kKeyPause = 255,
  // Beyond Quake's numbers: buttons of game controllers that newer engines have names for.
  kKeyDpadUp = 256,
  kKeyDpadDown,
  kKeyDpadLeft,
  kKeyDpadRight,
  kKeyGuide,
  kKeyMisc1,
  kKeyPaddle1,
  kKeyPaddle2,
  kKeyPaddle3,
  kKeyPaddle4,
  kKeyTouchpad,
  // Added to a controller's button while +altmodifier is held: "ABUTTON_ALT".
  kKeyAlternate = 512,
};

// The key that a controller's button is while +altmodifier is held; kKeyNone for others.
int alternate_key(int key);

// "SPACE", "MWHEELUP", "a", as `bind` writes them; empty if the number is no key.
std::string key_name(int key);

// The key of a name, ignoring case; kKeyNone if there is none.
int key_from_name(std::string_view name);

}  // namespace fb::platform
