#include "platform/sdl_events.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <utility>

namespace fb::platform {
namespace {

using Kind = InputEvent::Kind;

std::vector<InputEvent> translated(const SDL_Event& event) {
  std::vector<InputEvent> events;
  translate_event(event, events);
  return events;
}

SDL_Event of_type(Uint32 type) {
  SDL_Event event;
  std::memset(&event, 0, sizeof(event));
  event.type = type;
  return event;
}

TEST(Scancodes, ReachEveryKeyOfTheKeyboard) {
  std::set<int> keys;
  for (int code = 0; code < SDL_NUM_SCANCODES; ++code) keys.insert(key_from_scancode(static_cast<SDL_Scancode>(code)));
  for (char c = 'a'; c <= 'z'; ++c) EXPECT_TRUE(keys.count(c)) << c;
  for (char c = '0'; c <= '9'; ++c) EXPECT_TRUE(keys.count(c)) << c;
  for (int key = kKeyUpArrow; key <= kKeyScrollLock; ++key) EXPECT_TRUE(keys.count(key)) << key_name(key);
  EXPECT_EQ(key_from_scancode(SDL_SCANCODE_Z), 'z');
  EXPECT_EQ(key_from_scancode(SDL_SCANCODE_0), '0');
  EXPECT_EQ(key_from_scancode(SDL_SCANCODE_9), '9');
  EXPECT_EQ(key_from_scancode(SDL_SCANCODE_F12), kKeyF12);
  EXPECT_EQ(key_from_scancode(SDL_SCANCODE_KP_7), kKeypadHome);
  EXPECT_EQ(key_from_scancode(SDL_SCANCODE_VOLUMEUP), kKeyNone);
}

TEST(Events, KeysAndButtons) {
  SDL_Event event = of_type(SDL_KEYDOWN);
  event.key.keysym.scancode = SDL_SCANCODE_W;
  event.key.repeat = 1;
  auto events = translated(event);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kKey);
  EXPECT_EQ(events[0].key, 'w');
  EXPECT_TRUE(events[0].down);
  EXPECT_TRUE(events[0].repeat);
  EXPECT_EQ(events[0].letter, 0);
  event.key.keysym.sym = SDLK_COMMA;  // on a Dvorak keyboard
  EXPECT_EQ(translated(event)[0].letter, ',');
  event.key.keysym.sym = SDLK_KP_7;
  EXPECT_EQ(translated(event)[0].letter, 0);
  event.key.keysym.scancode = SDL_SCANCODE_VOLUMEUP;
  EXPECT_TRUE(translated(event).empty());

  event = of_type(SDL_MOUSEBUTTONUP);
  event.button.button = SDL_BUTTON_RIGHT;
  events = translated(event);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].key, kKeyMouse2);
  EXPECT_FALSE(events[0].down);
}

TEST(Events, EachStepOfTheWheelIsAKeyPress) {
  SDL_Event event = of_type(SDL_MOUSEWHEEL);
  event.wheel.y = -2;
  const auto events = translated(event);
  ASSERT_EQ(events.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(events[i].key, kKeyWheelDown);
    EXPECT_EQ(events[i].down, i % 2 == 0);
  }
  event.wheel.y = 0;  // sideways
  event.wheel.x = 1;
  EXPECT_TRUE(translated(event).empty());
}

TEST(Events, MotionTextFocusAndQuit) {
  SDL_Event event = of_type(SDL_MOUSEMOTION);
  event.motion.xrel = -3;
  event.motion.yrel = 4;
  auto events = translated(event);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kMouseMotion);
  EXPECT_EQ(events[0].dx, -3);
  EXPECT_EQ(events[0].dy, 4);

  event = of_type(SDL_TEXTINPUT);
  std::strcpy(event.text.text, "\xc3\xa4");
  events = translated(event);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kText);
  EXPECT_EQ(events[0].text, "\xc3\xa4");

  event = of_type(SDL_WINDOWEVENT);
  event.window.event = SDL_WINDOWEVENT_FOCUS_GAINED;
  events = translated(event);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kFocus);
  EXPECT_TRUE(events[0].focused);
  event.window.event = SDL_WINDOWEVENT_EXPOSED;
  EXPECT_TRUE(translated(event).empty());
  for (const auto& [which, by_user] :
       {std::pair(SDL_WINDOWEVENT_SIZE_CHANGED, false), {SDL_WINDOWEVENT_RESIZED, true}}) {
    event.window.event = static_cast<Uint8>(which);
    events = translated(event);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, Kind::kResize);
    EXPECT_EQ(events[0].by_user, by_user);
  }

  events = translated(of_type(SDL_QUIT));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kQuit);
}

}  // namespace
}  // namespace fb::platform
