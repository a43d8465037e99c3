// Keys and mouse over a demo, and its bar.
#include "host/game/demo_controls.h"

#include <gmock/gmock.h>

#include "client/test_demo.h"
#include "host/game/key_router.h"
#include "platform/keys.h"
#include "ui/menu/test_menu.h"

namespace fb::host {
namespace {

using Behind = KeyRouter::Behind;

class DemoControlsTest : public testing::Test {
 protected:
  DemoControlsTest()
      : files(cl::test::game_files()), library(files.loader()), client(console, library, files.loader()) {
    ui::register_hud_cvars(console);
    cl::test::DemoBuilder demo;
    for (int i = 0; i < 300; ++i) demo.moment(1.0f + 0.1f * static_cast<float>(i), 0.0f);
    for (const char* name : {"a.dem", "b.dem"}) files.files[name] = demo.bytes();
    keys.set_demo_keys([this](const platform::InputEvent& event) { return controls.handle(event); });
    console.execute("startdemos a b");
    frame();
    keys.set_behind(Behind::kDemo);
  }
  // A turn of the game's loop, a tenth of a second long.
  std::optional<ui::DemoBar> frame() {
    console.execute();
    client.advance(0.1);
    now += 0.1;
    return controls.frame({320, 200}, now);
  }
  void key(int number, bool down, bool repeat = false) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kKey;
    event.key = number;
    event.down = down;
    event.repeat = repeat;
    keys.handle(event);
  }
  void press(int number) {
    key(number, true);
    key(number, false);
    console.execute();
  }
  void move(float x, float y) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kMouseMotion;
    event.x = x;
    event.y = y;
    keys.handle(event);
  }
  double rate() const { return client.demo_status()->rate; }

  scene::test::TestFiles files;
  con::Console console;
  scene::ModelLibrary library;
  cl::Client client;
  ui::menu::TestFacts facts;
  KeyRouter keys{console, facts};
  DemoControls controls{console, client};
  double now = 10.0;
};

TEST_F(DemoControlsTest, KeysDirectTheDemo) {
  press(platform::kKeySpace);
  EXPECT_EQ(rate(), 0.0);
  press(platform::kKeyUpArrow);
  EXPECT_EQ(rate(), 1.0) << "the pause ends";
  press(platform::kKeyUpArrow);
  EXPECT_EQ(rate(), 2.0);
  press(platform::kKeyDownArrow);
  press(platform::kKeyDownArrow);
  EXPECT_EQ(rate(), 0.5);
  press(platform::kKeyUpArrow);
  key(platform::kKeyRightArrow, true);
  console.execute();
  EXPECT_EQ(rate(), 5.0);
  key(platform::kKeyLeftArrow, true);
  console.execute();
  EXPECT_EQ(rate(), -5.0) << "the key that was pressed last counts";
  key(platform::kKeyRightArrow, false);
  console.execute();
  EXPECT_EQ(rate(), -5.0);
  key(platform::kKeyLeftArrow, false);
  console.execute();
  EXPECT_EQ(rate(), 1.0);
  press('.');
  EXPECT_TRUE(client.demo_status()->paused);
  press(platform::kKeyPageDown);
  EXPECT_EQ(client.demo_name(), "b.dem");
  press(platform::kKeyPageUp);
  EXPECT_EQ(client.demo_name(), "a.dem");
  EXPECT_FALSE(keys.menu_open());
}

TEST_F(DemoControlsTest, AKeyThatIsHeldWorksOnce) {
  key(platform::kKeySpace, true);
  for (int i = 0; i < 4; ++i) key(platform::kKeySpace, true, true);
  console.execute();
  EXPECT_EQ(rate(), 0.0);
}

TEST_F(DemoControlsTest, OtherKeysOpenTheMenuWhichHasTheKeysThen) {
  key(platform::kKeyRightArrow, true);
  press('x');
  EXPECT_TRUE(keys.menu_open());
  press(platform::kKeySpace);
  EXPECT_EQ(rate(), 5.0);
  key(platform::kKeyRightArrow, false);
  console.execute();
  EXPECT_EQ(rate(), 1.0) << "what was held is let go wherever keys go";
}

TEST_F(DemoControlsTest, InAGameTheKeysAreTheGames) {
  console.execute("stopdemo");
  keys.set_behind(Behind::kGame);
  EXPECT_FALSE(controls.frame({320, 200}, now));
  press(platform::kKeySpace);
  move(160, 135);
  EXPECT_FALSE(controls.frame({320, 200}, now));
}

TEST_F(DemoControlsTest, TheBarComesWithAKeyAndGoes) {
  EXPECT_FALSE(frame()) << "nobody has touched anything";
  press(platform::kKeySpace);
  const auto bar = frame();
  ASSERT_TRUE(bar);
  EXPECT_EQ(bar->name, "a.dem");
  EXPECT_EQ(bar->rate, 0.0);
  EXPECT_NEAR(bar->length, 29.9, 1e-3);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(frame());
  for (int i = 0; i < 3; ++i) frame();
  EXPECT_FALSE(frame());
  console.execute("scr_demobar_timeout 0");
  EXPECT_TRUE(frame()) << "always";
  console.execute("scr_demobar_timeout -1");
  press(platform::kKeySpace);
  EXPECT_FALSE(frame()) << "never";
  console.execute("scr_demobar_timeout 1; timedemo b");
  press(platform::kKeySpace);
  EXPECT_FALSE(frame()) << "nor over a timedemo";
}

TEST_F(DemoControlsTest, TheMouseSeeks) {
  move(160, 135);
  EXPECT_TRUE(frame());
  key(platform::kKeyMouse1, true);
  auto bar = frame();
  ASSERT_TRUE(bar);
  EXPECT_NEAR(bar->seconds, 0.5 * 29.9, 0.05);
  EXPECT_NEAR(frame()->seconds, 0.5 * 29.9, 0.05) << "held, it stands still";
  move(87, 20);
  EXPECT_NEAR(frame()->seconds, 0.25 * 29.9, 0.05);
  key(platform::kKeyMouse1, false);
  EXPECT_EQ(rate(), 1.0);
  EXPECT_NEAR(frame()->seconds, 0.25 * 29.9 + 0.1, 0.05);
  key(platform::kKeyMouse1, true);
  EXPECT_NEAR(frame()->seconds, 0.25 * 29.9 + 0.2, 0.05) << "a click beside it is none";
  EXPECT_EQ(rate(), 1.0);
}

}  // namespace
}  // namespace fb::host
