#include "host/game/screenshot_name.h"

#include <gtest/gtest.h>

#include "base/test_directory.h"

namespace fb::host {
namespace {

TEST(ScreenshotName, IsTheFirstThatIsFree) {
  const TestDirectory directory;
  directory.put("base/id1/progs.dat", "code");
  fs::FsOptions options;
  options.base_dir = directory.file("base");
  options.user_dir = directory.file("user");
  const auto files = fs::FileSystem::open(options);
  ASSERT_TRUE(files.ok()) << files.error().message;
  EXPECT_EQ(free_screenshot_name(*files), "fullbright0000.png");
  directory.put("user/id1/screenshots/fullbright0000.png", "yesterday's");
  directory.put("user/id1/screenshots/fullbright0001.png", "another program's");
  EXPECT_EQ(free_screenshot_name(*files), "fullbright0002.png");
}

TEST(ScreenshotName, ThatIsTypedHasItsEndingOnce) {
  EXPECT_EQ(typed_screenshot_name("s"), "s.png");
  EXPECT_EQ(typed_screenshot_name("s.png"), "s.png");
  EXPECT_EQ(typed_screenshot_name("a.b"), "a.b.png");
  EXPECT_EQ(typed_screenshot_name("config.cfg"), "config.cfg.png")
      << "a server may say it, and writes over nothing else";
}

}  // namespace
}  // namespace fb::host
