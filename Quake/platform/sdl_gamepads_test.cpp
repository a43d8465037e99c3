// A virtual controller of SDL's takes the place of a real one.
#include "platform/sdl_gamepads.h"

#ifndef SDL_MAIN_HANDLED
#define SDL_MAIN_HANDLED
#endif
#include <SDL.h>

#include <gmock/gmock.h>

#include <utility>

namespace fb::platform {
namespace {

using testing::ElementsAre;

class GamepadsTest : public testing::Test {
 protected:
  void SetUp() override {
    SDL_SetMainReady();
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    if (SDL_InitSubSystem(SDL_INIT_EVENTS) != 0) GTEST_SKIP() << SDL_GetError();
    pads.use(true);
    device = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX,
                                       SDL_CONTROLLER_BUTTON_MAX, 0);
    if (device < 0) GTEST_SKIP() << SDL_GetError();
    poll();
    joystick = SDL_JoystickOpen(device);
    ASSERT_NE(joystick, nullptr);
    keys.clear();
  }
  void TearDown() override {
    pads.use(false);
    if (joystick) SDL_JoystickClose(joystick);
    if (device >= 0) SDL_JoystickDetachVirtual(device);
    SDL_QuitSubSystem(SDL_INIT_EVENTS);
  }
  void poll() {
    SDL_Event event;
    std::vector<InputEvent> events;
    while (SDL_PollEvent(&event)) pads.handle(event, events);
    for (const InputEvent& made : events) keys.push_back((made.down ? "+" : "-") + key_name(made.key));
  }
  void axis(SDL_GameControllerAxis which, int value) {
    SDL_JoystickSetVirtualAxis(joystick, which, static_cast<Sint16>(value));
    poll();
  }

  Gamepads pads;
  int device = -1;
  SDL_Joystick* joystick = nullptr;
  std::vector<std::string> keys;
};

TEST_F(GamepadsTest, ButtonsAreKeys) {
  SDL_JoystickSetVirtualButton(joystick, SDL_CONTROLLER_BUTTON_A, 1);
  poll();
  SDL_JoystickSetVirtualButton(joystick, SDL_CONTROLLER_BUTTON_A, 0);
  SDL_JoystickSetVirtualButton(joystick, SDL_CONTROLLER_BUTTON_DPAD_UP, 1);
  poll();
  EXPECT_THAT(keys, ElementsAre("+ABUTTON", "-ABUTTON", "+DPAD_UP"));
}
TEST(Buttons, OfNewerControllersAreKeys) {
  for (const auto& [button, name] : {std::pair{SDL_CONTROLLER_BUTTON_MISC1, "MISC1"},
                                     {SDL_CONTROLLER_BUTTON_PADDLE1, "PADDLE1"},
                                     {SDL_CONTROLLER_BUTTON_PADDLE4, "PADDLE4"},
                                     {SDL_CONTROLLER_BUTTON_TOUCHPAD, "TOUCHPAD"},
                                     {SDL_CONTROLLER_BUTTON_GUIDE, "GUIDE"},
                                     {SDL_CONTROLLER_BUTTON_DPAD_RIGHT, "DPAD_RIGHT"},
                                     {SDL_CONTROLLER_BUTTON_START, "ESCAPE"}})
    EXPECT_EQ(key_name(key_from_pad_button(button)), name);
}

// A trigger's way is the whole of a joystick's axis.
TEST_F(GamepadsTest, TriggersAreKeysBeyondTheirDeadZone) {
  const auto pull = [&](double part) {
    axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, static_cast<int>(65535.0 * part - 32768.0));
  };
  pull(0.0);
  keys.clear();
  pull(0.15);
  EXPECT_THAT(keys, ElementsAre());
  pull(0.25);
  pull(0.18);
  EXPECT_THAT(keys, ElementsAre("+RTRIGGER")) << "no flutter at the edge";
  pull(0.0);
  EXPECT_THAT(keys, ElementsAre("+RTRIGGER", "-RTRIGGER"));
}

// SDL's virtual controllers have no gyroscope here; its words are made up.
TEST_F(GamepadsTest, AGyroscopeTellsHowFarItWasTurned) {
  const auto tell = [&](std::uint32_t milliseconds, float up, float left) {
    SDL_Event event{};
    event.type = SDL_CONTROLLERSENSORUPDATE;
    event.csensor.timestamp = milliseconds;
    event.csensor.which = SDL_JoystickInstanceID(joystick);
    event.csensor.sensor = SDL_SENSOR_GYRO;
    event.csensor.data[0] = up;
    event.csensor.data[1] = left;
    std::vector<InputEvent> events;
    pads.handle(event, events);
  };
  tell(1000, 9.0f, 9.0f);  // since when is not known
  tell(1010, 1.0f, 2.0f);
  tell(1030, 1.0f, 0.0f);
  const vec3 turned = pads.take_sticks().turned;
  EXPECT_NEAR(turned.x, degrees(0.03f), 1e-4f);
  EXPECT_NEAR(turned.y, degrees(0.02f), 1e-4f);
  tell(2000, 1.0f, 1.0f);
  EXPECT_EQ(pads.take_sticks().turned, vec3(0.0f)) << "it was silent for a second";
  pads.rumble(0.5f, 0.1);  // it cannot, which is no failure
}

TEST_F(GamepadsTest, SticksAreFractions) {
  axis(SDL_CONTROLLER_AXIS_LEFTX, 32767);
  axis(SDL_CONTROLLER_AXIS_RIGHTY, -32768);
  EXPECT_EQ(pads.take_sticks().left, vec2(1.0f, 0.0f));
  EXPECT_EQ(pads.take_sticks().right, vec2(0.0f, -1.0f));
  pads.use(false);
  EXPECT_EQ(pads.take_sticks().left, vec2(0.0f));
}

}  // namespace
}  // namespace fb::platform
