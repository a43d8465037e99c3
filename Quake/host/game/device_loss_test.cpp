// A device that is lost in a game is replaced, and the game goes on; one that does not stay ends it with a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/log.h"
#include "base/test_directory.h"
#include "gpu/test_failures.h"
#include "host/base_game.h"
#include "host/game/game.h"

namespace fb::host {
namespace {

using testing::HasSubstr;
using testing::Not;

class DeviceLossTest : public testing::Test {
 protected:
  static constexpr int kFrames = 40;

  void SetUp() override {
    listener_ = add_log_listener([this](LogLevel, std::string_view line) { said_ += std::string(line) + "\n"; });
    std::vector<std::string> line{"-headless", "-validation", "-nosound",     "-size",    "32x24",
                                  "-nolan",    "-userdir",    home("user"),   "-capture", home("pictures"),
                                  "+viewmap",  "fb1",         "+r_first_spp", "1"};
    for (int i = 0; i < kFrames; ++i) line.push_back("+wait");
    line.push_back("+quit");
    const auto options = parse_game_options(with_base_game(line));
    ASSERT_TRUE(options.ok()) << options.error().message;
    auto game = Game::create(*options);
    if (!game) GTEST_SKIP() << game.error().message;
    game_ = std::move(*game);
  }
  void TearDown() override {
    game_.reset();
    remove_log_listener(listener_);
    EXPECT_THAT(said_, Not(HasSubstr("Vulkan validation")));
  }
  std::string home(const char* part) const { return (directory_.path() / part).string(); }

  int pictures() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(home("pictures")), {}));
  }
  std::string picture(int frame) const {
    std::ifstream file(home("pictures") + fmt::format("/frame_{:06}.png", frame), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const TestDirectory directory_;
  std::string said_;
  int listener_ = 0;
  std::unique_ptr<Game> game_;
};

TEST_F(DeviceLossTest, TheGameGoesOnWithANewOne) {
  {
    const gpu::LostDevice loss(20);
    EXPECT_EQ(game_->run(), 0);
    EXPECT_EQ(loss.lost(), 1);
    EXPECT_TRUE(loss.replaced());
  }
  EXPECT_THAT(said_, HasSubstr("the Vulkan device was lost: vkQueueSubmit; it is started anew"));
  EXPECT_GE(pictures(), kFrames - 1) << "only the frame that was drawn then may lack";
  EXPECT_GT(picture(kFrames - 1).size(), 300u);
}

TEST_F(DeviceLossTest, OneThatDoesNotStayEndsTheGame) {
  {
    const gpu::LostDevice loss(20, 2);
    EXPECT_EQ(game_->run(), 1);
    EXPECT_EQ(loss.lost(), 2);
  }
  EXPECT_THAT(said_, HasSubstr("again: it does not stay"));
}

}  // namespace
}  // namespace fb::host
