#include "host/game/screen.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/test_directory.h"
#include "host/game/engine.h"
#include "host/game/key_router.h"
#include "host/game/menu_facts.h"

namespace fb::host {
namespace {

class ScreenTest : public testing::Test {
 protected:
  ScreenTest() {
    for (const char* game : {"id1", "hipnotic", "quoth", "Rogue", "mod"})
      std::filesystem::create_directories(directory.path() / game);
  }
  std::unique_ptr<Engine> engine(const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"-basedir", directory.path().string(), "-nohome", "-nolan"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    auto made = Engine::create(arguments);
    return made.ok() ? std::move(*made) : nullptr;
  }
  const TestDirectory directory;
};

TEST_F(ScreenTest, RulesAreThoseOfTheMissionPackThatIsPlayed) {
  const auto rules = [&](const std::vector<std::string>& options) {
    const auto made = engine(options);
    return made ? static_cast<int>(made->rules()) : -1;
  };
  EXPECT_EQ(rules({}), static_cast<int>(ui::Rules::kQuake));
  EXPECT_EQ(rules({"-game", "mod"}), static_cast<int>(ui::Rules::kQuake));
  EXPECT_EQ(rules({"-hipnotic", "-game", "mod"}), static_cast<int>(ui::Rules::kHipnotic));
  EXPECT_EQ(rules({"-quoth"}), static_cast<int>(ui::Rules::kHipnotic));
  EXPECT_EQ(rules({"-game", "Rogue"}), static_cast<int>(ui::Rules::kRogue));
}

TEST_F(ScreenTest, WithoutAGameTheConsoleFillsThePictureUnlessItsLinesAreLeftOut) {
  const auto made = engine({});
  ASSERT_NE(made, nullptr);
  MenuFacts facts(*made);
  KeyRouter keys(made->console(), facts);
  Screen screen(made->console(), {.read_file = made->files().loader()}, keys, made->rules());
  made->console().execute("echo a line");
  Screen::Moment moment{{640, 400}, 1.0, 0.01, false};
  EXPECT_TRUE(screen.draw(made->client(), moment).quads.empty());
  moment.lines = true;
  const scene::DrawList& list = screen.draw(made->client(), moment);
  ASSERT_GT(list.quads.size(), 6u);
  EXPECT_GE(list.quads.front().max.x, 640.0f);
  EXPECT_GE(list.quads.front().max.y, 400.0f);
  // A scale of one's own applies, whatever the size.
  const float letter = list.quads.back().max.y - list.quads.back().min.y;
  made->console().execute("scr_conscale 2");
  const scene::DrawQuad& last = screen.draw(made->client(), moment).quads.back();
  EXPECT_EQ(last.max.y - last.min.y, 2.0f * letter);
}

}  // namespace
}  // namespace fb::host
