// The menus' pages by name.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "console/bindings.h"
#include "console/console.h"
#include "ui/menu/facts.h"
#include "ui/menu/page.h"

namespace fb::ui::menu {

// What is chosen for a game to come, on "multiplayer/host".
struct HostForm {
  std::string map = "start";
  int players = 8;
  bool coop = false;
};

// What pages are made from; all must outlive the pages.
struct Sources {
  con::Console& console;
  const con::Bindings& bindings;
  Facts& facts;
  HostForm& form;
};

struct PageInfo {
  const char* name;
  const char* parent;   // where going back leads if the page was opened by a command; empty: the menu closes
  const char* command;  // the console's command that opens it; empty: none
  std::function<Page(const Sources& sources)> make;
};

// Every page; the name of a page is unique.
const std::vector<PageInfo>& page_list();
// nullptr if there is no page of this name.
const PageInfo* find_page(std::string_view name);

// The rows of the archived cvars of a group; all groups, each under its heading, if the name is empty.
std::vector<Row> setting_rows(const con::Console& console, std::string_view group);
// The groups' names that have rows, and the group of a cvar by its name.
std::vector<std::string> setting_groups(const con::Console& console);
std::string_view setting_group(const con::Cvar& cvar);
// A cvar's row: its name or `label`, its help, default and range.
Row setting_row(const con::Cvar& cvar, std::string label = {});
Row setting_row(const con::Cvar& cvar, std::string label, Control control);

// Makers, by file.
Page main_page(const Sources& sources);  // pages_main.cpp
Page single_player_page(const Sources& sources);
Page new_game_page(const Sources& sources);
Page help_page(const Sources& sources);
Page credits_page(const Sources& sources);
Page quit_page(const Sources& sources);
Page load_page(const Sources& sources);  // pages_lists.cpp
Page save_page(const Sources& sources);
Page dead_page(const Sources& sources);
Page maps_page(const Sources& sources);
Page demos_page(const Sources& sources);
Page mods_page(const Sources& sources);
Page options_page(const Sources& sources);  // pages_options.cpp
Page video_page(const Sources& sources);
Page sound_page(const Sources& sources);
Page settings_page(const Sources& sources);
Page all_settings_page(const Sources& sources);
Page keys_page(const Sources& sources);         // pages_keys.cpp
Page multiplayer_page(const Sources& sources);  // pages_multiplayer.cpp
Page join_page(const Sources& sources);
Page host_page(const Sources& sources);
Page host_map_page(const Sources& sources);
Page setup_page(const Sources& sources);

}  // namespace fb::ui::menu
