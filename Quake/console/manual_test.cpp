#include "console/manual.h"

#include <gmock/gmock.h>

namespace fb::con {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Manual, HasCommandsAndCvarsInTheirTables) {
  Console game, dedicated;
  game.add_command("fly", "fly <height|low>: rise", [](const Args&) {});
  game.add_cvar({"wind", "3", "strength a_b, 1|2", kCvarArchive, 0.0f, 9.0f, true});
  game.add_cvar("place", "/somewhere", "where it is", kCvarRom);
  game.add_cvar("old", "1", "gone; no effect here", kCvarNoEffect);
  dedicated.add_command("kick", "kick <player>: send away", [](const Args&) {});
  dedicated.add_cvar("wind", "3", "known already");
  dedicated.add_cvar("ticks", "", "how often");
  const std::string page = commands_page(game, dedicated);
  const std::string server = page.substr(page.find("## On a dedicated server"));
  EXPECT_THAT(page, HasSubstr("| `fly <height/low>` | rise |\n"));
  EXPECT_THAT(page, HasSubstr("| `wind` | 3 | whole numbers 0 to 9 | kept | strength a\\_b, 1\\|2 |\n"));
  EXPECT_THAT(page, HasSubstr("| `place` |  |  | read-only | where it is |\n"));
  EXPECT_THAT(page, Not(HasSubstr("/somewhere"))) << "which another machine has elsewhere";
  EXPECT_THAT(server, HasSubstr("| `kick <player>` | send away |\n"));
  EXPECT_THAT(server, HasSubstr("| `ticks` | (empty) |"));
  EXPECT_THAT(server, Not(HasSubstr("`wind`")));
  EXPECT_THAT(page.substr(page.find("## Without effect")), HasSubstr("| `old` | 1 | gone; no effect here |\n"));
}

TEST(Manual, FindsWhatHasNoHelp) {
  Console console;
  EXPECT_THAT(names_without_help(console), ElementsAre()) << "the console's own commands";
  console.add_command("fly", "", [](const Args&) {});
  console.add_cvar("wind", "3", "");
  EXPECT_THAT(names_without_help(console), ElementsAre("fly", "wind"));
}

}  // namespace
}  // namespace fb::con
