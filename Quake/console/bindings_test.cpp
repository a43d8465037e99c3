#include "console/bindings.h"

#include <gmock/gmock.h>

namespace fb::con {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Keys a to z, and SPACE.
class BindingsTest : public testing::Test {
 protected:
  BindingsTest()
      : bindings(
            console,
            [](std::string_view name) {
              if (same_name(name, "SPACE")) return 32;
              return name.size() == 1 ? static_cast<int>(name[0]) : 0;
            },
            [](int key) { return key == 32 ? std::string("SPACE") : std::string(1, static_cast<char>(key)); }) {
    for (const char* name : {"do", "+jump", "-jump"}) {
      console.add_command(name, "", [this](const Args& args) { done.push_back(args.joined(0)); });
    }
  }
  void press(int key, bool down) {
    bindings.key_event(key, down);
    console.execute();
  }

  Console console;
  Bindings bindings;
  std::vector<std::string> done;
};

TEST_F(BindingsTest, CommandsRunWhenTheKeyGoesDown) {
  console.execute("bind x \"do 1; do 2\"");
  press('x', true);
  press('x', false);
  press('y', true);
  EXPECT_THAT(done, ElementsAre("do 1", "do 2"));
}

TEST_F(BindingsTest, ButtonsSayWhichKey) {
  console.execute("bind SPACE +jump");
  press(32, true);
  press(32, false);
  press(32, false);
  EXPECT_THAT(done, ElementsAre("+jump 32", "-jump 32"));
}

TEST_F(BindingsTest, AButtonComesUpAlsoAfterItsKeyIsBoundElsewhere) {
  console.execute("bind x +jump");
  press('x', true);
  console.execute("unbindall");
  press('x', false);
  EXPECT_THAT(done, ElementsAre("+jump 120", "-jump 120"));
  console.execute("bind x +jump");
  press('x', true);
  bindings.release_all();
  console.execute();
  EXPECT_EQ(done.back(), "-jump 120");
}

TEST_F(BindingsTest, ShowsAndRefuses) {
  console.execute("bind x do it");
  EXPECT_EQ(bindings.command('x'), "do it");
  console.execute("bind x");
  EXPECT_EQ(console.scrollback().latest(1).front().text, "\"x\" = \"do it\"");
  console.execute("bind nokey 1");
  EXPECT_THAT(console.scrollback().latest(1).front().text, HasSubstr("isn't a valid key"));
  console.execute("unbind x; bind x");
  EXPECT_THAT(console.scrollback().latest(1).front().text, HasSubstr("not bound"));
  EXPECT_THAT(done, IsEmpty());
}

TEST_F(BindingsTest, ConfigReadsBack) {
  console.execute("bind SPACE +jump; bind ; \"do 1; do 2\"; bind x \"do 1; do 2\"");
  const std::string text = console.config_text();
  EXPECT_EQ(text, "unbindall\nbind \"SPACE\" \"+jump\"\nbind \"x\" \"do 1; do 2\"\n");
  console.execute("unbindall");
  console.execute(text);
  EXPECT_EQ(console.config_text(), text);
}

}  // namespace
}  // namespace fb::con
