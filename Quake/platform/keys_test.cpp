#include "platform/keys.h"

#include <gtest/gtest.h>

#include <set>

namespace fb::platform {
namespace {

// The numbers are Quake's: mods and old configuration files know some of them.
TEST(Keys, HaveQuakesNumbers) {
  EXPECT_EQ(kKeyUpArrow, 128);
  EXPECT_EQ(kKeyShift, 134);
  EXPECT_EQ(kKeyF1, 135);
  EXPECT_EQ(kKeyF12, 146);
  EXPECT_EQ(kKeyInsert, 147);
  EXPECT_EQ(kKeyEnd, 152);
  EXPECT_EQ(kKeyWheelDown, 240);
}

TEST(Keys, NamesGoBothWays) {
  std::set<std::string> names;
  for (int key = 0; key < 1024; ++key) {
    const std::string name = key_name(key);
    if (name.empty()) continue;
    EXPECT_TRUE(names.insert(name).second) << name;
    if (key >= 'A' && key <= 'Z')
      EXPECT_EQ(key_from_name(name), key - 'A' + 'a');  // keys are lower case
    else
      EXPECT_EQ(key_from_name(name), key) << name;
  }
  EXPECT_EQ(names.count("MWHEELUP"), 1u);
  EXPECT_EQ(names.count("KP_NUMLOCK"), 1u);
}

// So that a configuration that other engines share loses none of its bindings.
TEST(Keys, JoysticksAndControllersHaveQuakeSpasmsNumbers) {
  EXPECT_EQ(key_from_name("JOY1"), 203);
  EXPECT_EQ(key_from_name("joy4"), 206);
  EXPECT_EQ(key_from_name("AUX1"), 207);
  EXPECT_EQ(key_from_name("AUX32"), 238);
  EXPECT_EQ(key_from_name("LTHUMB"), 243);
  EXPECT_EQ(key_from_name("RTRIGGER"), 252);
  EXPECT_EQ(key_from_name("JOY5"), kKeyNone);
  EXPECT_EQ(key_from_name("AUX33"), kKeyNone);
}

// Names of Ironwail's and vkQuake's configurations.
TEST(Keys, ButtonsOfNewerEnginesHaveNames) {
  for (const char* name :
       {"DPAD_UP",       "DPAD_DOWN",     "DPAD_LEFT",      "DPAD_RIGHT",    "GUIDE",         "MISC1",
        "PADDLE1",       "PADDLE2",       "PADDLE3",        "PADDLE4",       "TOUCHPAD",      "CAPSLOCK",
        "SCROLLLOCK",    "LTHUMB_ALT",    "RTHUMB_ALT",     "LSHOULDER_ALT", "RSHOULDER_ALT", "DPAD_UP_ALT",
        "DPAD_DOWN_ALT", "DPAD_LEFT_ALT", "DPAD_RIGHT_ALT", "ABUTTON_ALT",   "BBUTTON_ALT",   "XBUTTON_ALT",
        "YBUTTON_ALT",   "LTRIGGER_ALT",  "RTRIGGER_ALT",   "MISC1_ALT",     "PADDLE1_ALT",   "PADDLE4_ALT",
        "TOUCHPAD_ALT"}) {
    EXPECT_NE(key_from_name(name), kKeyNone) << name;
    EXPECT_EQ(key_name(key_from_name(name)), name);
  }
  EXPECT_EQ(key_from_name("NUMLOCK"), kKeypadNumLock);
  EXPECT_EQ(key_name(kKeypadNumLock), "KP_NUMLOCK");
  EXPECT_EQ(key_from_name("capslock"), 171);
  EXPECT_EQ(alternate_key(kKeyAButton), key_from_name("abutton_alt"));
  for (const char* none : {"SPACE_ALT", "GUIDE_ALT", "_ALT", "ABUTTON_ALT_ALT", "a_alt", "PADDLE5"})
    EXPECT_EQ(key_from_name(none), kKeyNone) << none;
}

TEST(Keys, NamesInAnyCase) {
  EXPECT_EQ(key_from_name("mouse1"), kKeyMouse1);
  EXPECT_EQ(key_from_name("f11"), kKeyF1 + 10);
  EXPECT_EQ(key_from_name("semicolon"), ';');
  EXPECT_EQ(key_from_name("W"), 'w');
}

TEST(Keys, WhatIsNoKeyHasNoName) {
  EXPECT_EQ(key_name(-1), "");
  EXPECT_EQ(key_name(0), "");
  EXPECT_EQ(key_name(1000), "");
  EXPECT_EQ(key_from_name(""), kKeyNone);
  EXPECT_EQ(key_from_name("F13"), kKeyNone);
  EXPECT_EQ(key_from_name("\x80"), kKeyNone);
}

}  // namespace
}  // namespace fb::platform
