// The main menu, single player, help, credits, quit.
#include <fmt/format.h>

#include "ui/menu/pages.h"
#include "ui/menu/rows.h"

namespace fb::ui::menu {
namespace {

constexpr int kHelpPages = 6;

struct Skill {
  const char *name, *help;
};
constexpr Skill kSkills[] = {{"Easy", "fewer monsters, less damage"},
                             {"Normal", "the game as its makers meant it"},
                             {"Hard", "more monsters, and stronger ones"},
                             {"Nightmare", "monsters hardly pause between attacks"}};

// Leaves what is played for a game of one player on this map.
std::string new_game_command(const std::string& map) {
  return fmt::format("disconnect; maxplayers 1; deathmatch 0; coop 0; map {}", con::in_quotes(map));
}

}  // namespace

Row action(std::string label, std::string command, std::string help) {
  Row row;
  row.label = std::move(label);
  row.command = std::move(command);
  row.help = std::move(help);
  return row;
}

Row link(std::string label, std::string page, std::string help) {
  Row row;
  row.label = std::move(label);
  row.page = std::move(page);
  row.help = std::move(help);
  return row;
}

Row new_game(const Sources& sources, std::string label, const std::string& map, const std::string& before) {
  Row row = action(std::move(label), before + new_game_command(map));
  row.closes = true;
  if (sources.facts.in_game()) row.question = "Leave this game and begin a new one?";
  return row;
}

Row heading(std::string label) {
  Row row;
  row.kind = Row::Kind::kHeading;
  row.label = std::move(label);
  return row;
}

Row skill_row(const con::Console& console) {
  std::vector<Control::Choice> choices;
  for (std::size_t i = 0; i < std::size(kSkills); ++i) choices.push_back({std::to_string(i), kSkills[i].name});
  Row row = setting_row(console.cvar("skill"), "Skill", choice_of(console.cvar("skill"), std::move(choices)));
  row.help = "how hard the next game is, unless its map lets you choose";
  return row;
}

Page main_page(const Sources&) {
  Page page;
  page.title = "Main";
  page.title_picture = "gfx/ttl_main.lmp";
  page.list_picture = "gfx/mainmenu.lmp";
  page.rows = {link("Single Player", "singleplayer"), link("Multiplayer", "multiplayer"), link("Options", "options"),
               link("Help", "help"), link("Quit", "quit")};
  page.listed_rows = page.rows.size();
  page.rows.push_back(link("Mods", "mods", "play with another game folder, install a mod"));
  page.rows.push_back(link("Demos", "demos", "watch a recorded game"));
  page.rows.push_back(link("Credits", "credits"));
  return page;
}

Page single_player_page(const Sources& sources) {
  Page page;
  page.title = "Single Player";
  page.title_picture = "gfx/ttl_sgl.lmp";
  page.list_picture = "gfx/sp_menu.lmp";
  const std::vector<MapEntry> starts = sources.facts.start_maps();
  const bool at_once = starts.size() == 1 && starts.front().chooses_skill;
  page.rows.push_back(at_once ? new_game(sources, "New Game", starts.front().name)
                              : link("New Game", "singleplayer/new"));
  page.rows.push_back(link("Load", "load"));
  page.rows.push_back(link("Save", "save"));
  page.listed_rows = page.rows.size();
  page.rows.push_back(link("Maps", "maps", "begin at any map"));
  page.rows.push_back(skill_row(sources.console));
  return page;
}

Page new_game_page(const Sources& sources) {
  Page page;
  page.title = "New Game";
  page.title_picture = "gfx/ttl_sgl.lmp";
  const std::vector<MapEntry> starts = sources.facts.start_maps();
  if (starts.size() == 1 && !starts.front().chooses_skill) {
    for (std::size_t i = 0; i < std::size(kSkills); ++i) {
      Row row = new_game(sources, kSkills[i].name, starts.front().name, fmt::format("skill {}; ", i));
      row.help = kSkills[i].help;
      page.rows.push_back(std::move(row));
    }
    page.listed_rows = page.rows.size();
    return page;
  }
  page.rows.push_back(skill_row(sources.console));
  for (const MapEntry& map : starts) {
    Row row = new_game(sources, map.title.empty() ? map.name : map.title, map.name);
    row.value = map.name;
    page.rows.push_back(std::move(row));
  }
  page.rows.push_back(link("Any map", "maps"));
  page.value_column = 0.65f;
  return page;
}

Page help_page(const Sources&) {
  Page page;
  page.title = "Help";
  page.plaque = false;
  for (int i = 0; i < kHelpPages; ++i) page.pictures.push_back(fmt::format("gfx/help{}.lmp", i));
  for (const char* line :
       {"W A S D  or arrows: walk, step aside", "mouse: look; its buttons fire and jump", "1 to 8, wheel: weapons",
        "SHIFT: run or walk", "TAB: scores    PAUSE: pause", "T, Y: talk to all, to the team",
        "F2, F3: save, load   F6, F9: quick", "ESC: menu    `: console"})
    page.rows.push_back(heading(line));
  return page;
}

Page credits_page(const Sources& sources) {
  Page page;
  page.title = "Credits";
  page.plaque = false;
  page.rows = {heading(sources.facts.version()),
               heading(""),
               heading("A Quake engine that traces light."),
               heading("GPL version 2 or later."),
               heading(""),
               heading("Quake is by id Software, 1996."),
               heading("Its rules, formats and protocols are kept"),
               heading("as QuakeSpasm keeps them."),
               heading("Game data has its own authors:"),
               heading("see the files that come with it.")};
  return page;
}

Page quit_page(const Sources&) {
  Page page;
  page.title = "Quit";
  page.plaque = true;
  page.rows = {heading("Leave the game?"), heading("What is not saved is lost."), heading("")};
  page.rows.push_back(action("Yes, quit", "quit"));
  page.rows.back().letter = 'y';
  Row stay;
  stay.label = "No, stay";
  stay.letter = 'n';
  stay.goes_back = true;
  page.rows.push_back(std::move(stay));
  return page;
}

}  // namespace fb::ui::menu
