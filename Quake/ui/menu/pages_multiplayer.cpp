// Multiplayer: joining and hosting a game, the player's name and colours.
#include <fmt/format.h>

#include <cstdlib>

#include "ui/menu/pages.h"
#include "ui/menu/rows.h"

namespace fb::ui::menu {
namespace {

constexpr int kMostPlayers = 16, kMostColor = 13;

Row cvar_row(const con::Console& console, const char* name, std::string label,
             const std::vector<Control::Choice>& choices) {
  const con::Cvar& cvar = console.cvar(name);
  return setting_row(cvar, std::move(label), choice_of(cvar, choices));
}

// A row of the form: what it holds is no cvar.
Row form_row(std::string label, Control::Kind kind, std::function<std::string()> read,
             std::function<void(std::string_view)> write) {
  Row row;
  row.kind = Row::Kind::kSetting;
  row.label = std::move(label);
  Control control;
  control.kind = kind;
  control.read = std::move(read);
  control.command = [write = std::move(write)](std::string_view value) {
    write(value);
    return std::string();
  };
  row.control = std::move(control);
  return row;
}

// Shirt or trousers: the two are one cvar.
Row color_row(const con::Console& console, bool shirt) {
  const con::Cvar& colors = console.cvar("_cl_color");
  Row row;
  row.kind = Row::Kind::kSetting;
  row.label = shirt ? "Shirt" : "Trousers";
  Control control;
  control.kind = Control::Kind::kColor;
  control.max = kMostColor;
  control.read = [&colors, shirt] { return std::to_string(shirt ? colors.integer() / 16 : colors.integer() % 16); };
  control.command = [&colors, shirt](std::string_view value) {
    const int other = shirt ? colors.integer() % 16 : colors.integer() / 16;
    return shirt ? fmt::format("color {} {}", value, other) : fmt::format("color {} {}", other, value);
  };
  control.default_value = "0";
  row.control = std::move(control);
  row.help = "color: left and right choose";
  return row;
}

std::string host_command(const HostForm& form) {
  return fmt::format("disconnect; listen 0; maxplayers {}; listen 1; deathmatch {}; coop {}; map {}", form.players,
                     form.coop ? 0 : 1, form.coop ? 1 : 0, con::in_quotes(form.map));
}

}  // namespace

Page multiplayer_page(const Sources&) {
  Page page;
  page.title = "Multiplayer";
  page.title_picture = "gfx/p_multi.lmp";
  page.list_picture = "gfx/mp_menu.lmp";
  page.rows = {link("Join a Game", "multiplayer/join"), link("New Game", "multiplayer/host"), link("Setup", "setup")};
  page.listed_rows = page.rows.size();
  return page;
}

Page join_page(const Sources& sources) {
  Page page;
  page.title = "Join a Game";
  page.opening = "slist";
  page.title_picture = "gfx/p_multi.lmp";
  page.plaque = false;
  page.live = true;
  page.value_column = 0.42f;
  Row address;
  address.kind = Row::Kind::kSetting;
  address.label = "Address";
  address.help = "a server's name or address, with or without :port";
  Control control;
  control.kind = Control::Kind::kText;
  control.read = [] { return std::string(); };
  control.command = [](std::string_view value) {
    return value.empty() ? std::string() : fmt::format("connect {}", con::in_quotes(value));
  };
  address.control = std::move(control);
  page.rows.push_back(std::move(address));
  const bool searching = sources.facts.searching_servers();
  Row search = action(searching ? "Searching..." : "Search the local network", "slist");
  search.enabled = !searching;
  page.rows.push_back(std::move(search));
  page.rows.push_back(heading(""));
  for (const ServerEntry& server : sources.facts.servers()) {
    Row row = action(server.name, "connect " + con::in_quotes(server.address));
    row.value = fmt::format("{:<12.12} {:>2}/{:<2}", server.map, server.players, server.max_players);
    row.help = server.address + (server.compatible ? "" : ": speaks another version");
    row.closes = true;
    row.enabled = server.compatible;
    page.rows.push_back(std::move(row));
  }
  return page;
}

Page host_page(const Sources& sources) {
  const con::Console& console = sources.console;
  HostForm& form = sources.form;
  Page page;
  page.title = "New Game";
  page.title_picture = "gfx/p_multi.lmp";
  page.live = true;
  page.value_column = 0.58f;
  Row begin = action("Begin game", "", "others may join over the network");
  begin.command_now = [&form] { return host_command(form); };  // as the form stands then
  begin.closes = true;
  if (sources.facts.in_game()) begin.question = "Leave this game and begin a new one?";
  page.rows.push_back(std::move(begin));
  Row map = link("Map", "multiplayer/host/map");
  map.value = form.map;
  page.rows.push_back(std::move(map));
  Row players = form_row(
      "Players", Control::Kind::kSlider, [&form] { return std::to_string(form.players); },
      [&form](std::string_view value) { form.players = std::atoi(std::string(value).c_str()); });
  players.control->min = 2;
  players.control->max = kMostPlayers;
  players.control->step = 1;
  players.control->integer = true;
  page.rows.push_back(std::move(players));
  Row kind = form_row(
      "Game", Control::Kind::kChoice, [&form] { return std::string(form.coop ? "1" : "0"); },
      [&form](std::string_view value) { form.coop = value == "1"; });
  kind.control->choices = {{"1", "cooperative"}, {"0", "deathmatch"}};
  page.rows.push_back(std::move(kind));
  page.rows.push_back(
      cvar_row(console, "teamplay", "Teamplay", {{"0", "off"}, {"1", "no friendly fire"}, {"2", "friendly fire"}}));
  page.rows.push_back(skill_row(console));
  std::vector<Control::Choice> frags{{"0", "none"}}, minutes{{"0", "none"}};
  for (int i = 1; i <= 10; ++i) frags.push_back({std::to_string(10 * i), std::to_string(10 * i)});
  for (int i = 1; i <= 12; ++i) minutes.push_back({std::to_string(5 * i), fmt::format("{} minutes", 5 * i)});
  page.rows.push_back(cvar_row(console, "fraglimit", "Frag limit", frags));
  page.rows.push_back(cvar_row(console, "timelimit", "Time limit", minutes));
  Row name = setting_row(console.cvar("hostname"), "Server's name");
  page.rows.push_back(std::move(name));
  return page;
}

Page host_map_page(const Sources& sources) {
  Page page;
  page.title = "Map";
  page.plaque = false;
  page.searchable = true;
  page.live = true;
  page.value_column = 0.4f;
  for (const MapEntry& map : sources.facts.maps()) {
    Row row;
    row.label = map.name;
    row.value = map.title;
    row.choose = [&form = sources.form, name = map.name] { form.map = name; };
    row.goes_back = true;
    page.rows.push_back(std::move(row));
  }
  return page;
}

Page setup_page(const Sources& sources) {
  const con::Console& console = sources.console;
  Page page;
  page.title = "Setup";
  page.title_picture = "gfx/p_multi.lmp";
  page.value_column = 0.5f;
  Row name = setting_row(console.cvar("_cl_name"), "Your name");
  name.control->command = [](std::string_view value) { return fmt::format("name {}", con::in_quotes(value)); };
  name.help = "name: what others call you, up to 15 letters";
  page.rows.push_back(std::move(name));
  page.rows.push_back(setting_row(console.cvar("hostname"), "Server's name"));
  page.rows.push_back(color_row(console, true));
  page.rows.push_back(color_row(console, false));
  return page;
}

}  // namespace fb::ui::menu
