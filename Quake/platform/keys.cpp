#include "platform/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace fb::platform {
namespace {

struct Named {
  int key;
  std::string_view name;
};

// A semicolon separates commands, so configuration files need a name for its key; a quote opens a string.
constexpr Named kNamed[] = {{kKeyTab, "TAB"},
                            {kKeyEnter, "ENTER"},
                            {kKeyEscape, "ESCAPE"},
                            {kKeySpace, "SPACE"},
                            {kKeyBackspace, "BACKSPACE"},
                            {kKeyUpArrow, "UPARROW"},
                            {kKeyDownArrow, "DOWNARROW"},
                            {kKeyLeftArrow, "LEFTARROW"},
                            {kKeyRightArrow, "RIGHTARROW"},
                            {kKeyAlt, "ALT"},
                            {kKeyCtrl, "CTRL"},
                            {kKeyShift, "SHIFT"},
                            {kKeyInsert, "INS"},
                            {kKeyDelete, "DEL"},
                            {kKeyPageDown, "PGDN"},
                            {kKeyPageUp, "PGUP"},
                            {kKeyHome, "HOME"},
                            {kKeyEnd, "END"},
                            {kKeypadNumLock, "KP_NUMLOCK"},
                            {kKeypadSlash, "KP_SLASH"},
                            {kKeypadStar, "KP_STAR"},
                            {kKeypadMinus, "KP_MINUS"},
                            {kKeypadHome, "KP_HOME"},
                            {kKeypadUpArrow, "KP_UPARROW"},
                            {kKeypadPageUp, "KP_PGUP"},
                            {kKeypadPlus, "KP_PLUS"},
                            {kKeypadLeftArrow, "KP_LEFTARROW"},
                            {kKeypad5, "KP_5"},
                            {kKeypadRightArrow, "KP_RIGHTARROW"},
                            {kKeypadEnd, "KP_END"},
                            {kKeypadDownArrow, "KP_DOWNARROW"},
                            {kKeypadPageDown, "KP_PGDN"},
                            {kKeypadEnter, "KP_ENTER"},
                            {kKeypadInsert, "KP_INS"},
                            {kKeypadDelete, "KP_DEL"},
                            {kKeyCommand, "COMMAND"},
                            {kKeyCapsLock, "CAPSLOCK"},
                            {kKeyScrollLock, "SCROLLLOCK"},
                            {kKeyMouse1, "MOUSE1"},
                            {kKeyMouse2, "MOUSE2"},
                            {kKeyMouse3, "MOUSE3"},
                            {kKeyMouse4, "MOUSE4"},
                            {kKeyMouse5, "MOUSE5"},
                            {kKeyWheelUp, "MWHEELUP"},
                            {kKeyWheelDown, "MWHEELDOWN"},
                            {kKeyLeftThumb, "LTHUMB"},
                            {kKeyRightThumb, "RTHUMB"},
                            {kKeyLeftShoulder, "LSHOULDER"},
                            {kKeyRightShoulder, "RSHOULDER"},
                            {kKeyAButton, "ABUTTON"},
                            {kKeyBButton, "BBUTTON"},
                            {kKeyXButton, "XBUTTON"},
                            {kKeyYButton, "YBUTTON"},
                            {kKeyLeftTrigger, "LTRIGGER"},
                            {kKeyRightTrigger, "RTRIGGER"},
                            {kKeyPrintScreen, "PRINTSCREEN"},
                            {kKeyPause, "PAUSE"},
                            {kKeyDpadUp, "DPAD_UP"},
                            {kKeyDpadDown, "DPAD_DOWN"},
                            {kKeyDpadLeft, "DPAD_LEFT"},
                            {kKeyDpadRight, "DPAD_RIGHT"},
                            {kKeyGuide, "GUIDE"},
                            {kKeyMisc1, "MISC1"},
                            {kKeyPaddle1, "PADDLE1"},
                            {kKeyPaddle2, "PADDLE2"},
                            {kKeyPaddle3, "PADDLE3"},
                            {kKeyPaddle4, "PADDLE4"},
                            {kKeyTouchpad, "TOUCHPAD"},
                            {';', "SEMICOLON"},
                            {'`', "BACKQUOTE"},
                            {'~', "TILDE"},
                            {kKeypadNumLock, "NUMLOCK"}};  // its other name

constexpr std::string_view kAlternateEnd = "_ALT";

// Keys whose names end in a number, from 1.
struct Numbered {
  int first, count;
  std::string_view name;
};
constexpr Numbered kNumbered[] = {{kKeyF1, 12, "F"}, {kKeyJoy1, 4, "JOY"}, {kKeyAux1, 32, "AUX"}};

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

}  // namespace

int alternate_key(int key) {
  const bool is_pad = (key >= kKeyLeftThumb && key <= kKeyRightTrigger) || (key >= kKeyDpadUp && key <= kKeyTouchpad);
  return is_pad && key != kKeyGuide ? key + kKeyAlternate : kKeyNone;
}

std::string key_name(int key) {
  if (key > kKeyAlternate)
    return alternate_key(key - kKeyAlternate) == key ? key_name(key - kKeyAlternate) + std::string(kAlternateEnd)
                                                     : std::string();
  for (const Numbered& keys : kNumbered)
    if (key >= keys.first && key < keys.first + keys.count) return fmt::format("{}{}", keys.name, key - keys.first + 1);
  for (const Named& named : kNamed)
    if (named.key == key) return std::string(named.name);
  if (key > kKeySpace && key < kKeyBackspace) return std::string(1, static_cast<char>(key));
  return {};
}

int key_from_name(std::string_view name) {
  if (name.size() == 1) {
    const auto c = static_cast<unsigned char>(name[0]);
    return c > kKeySpace && c < kKeyBackspace ? std::tolower(c) : kKeyNone;
  }
  for (const Numbered& keys : kNumbered)
    for (int key = keys.first; key < keys.first + keys.count; ++key)
      if (same_word(name, key_name(key))) return key;
  for (const Named& named : kNamed)
    if (same_word(name, named.name)) return named.key;
  if (name.size() > kAlternateEnd.size() && same_word(name.substr(name.size() - kAlternateEnd.size()), kAlternateEnd))
    return alternate_key(key_from_name(name.substr(0, name.size() - kAlternateEnd.size())));
  return kKeyNone;
}

}  // namespace fb::platform
