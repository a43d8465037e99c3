#include "ui/menu/pages.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace fb::ui::menu {
namespace {

// Groups of cvars that name none of their own, in the menu's order; those that name one stand after kBeforeOwn.
constexpr std::string_view kControls = "Controls", kPads = "Game pads", kScreen = "Screen",
                           kWindow = "Window and speed", kPicture = "Picture", kEmission = "Emission", kSound = "Sound",
                           kGame = "Game", kOthers = "Others", kOtherEngines = "Other engines";
constexpr std::string_view kGroups[] = {kControls, kPads, kScreen, kWindow,      kPicture,
                                        kSound,    kGame, kOthers, kOtherEngines};
constexpr std::string_view kBeforeOwn = kPicture;

// The first row whose words begin the cvar's name says where it belongs.
struct Prefix {
  std::string_view begins, group;
};
constexpr Prefix kPrefixes[] = {{"joy_", kPads},
                                {"cl_alwaysrun", kControls},
                                {"cl_max", kControls},
                                {"cl_min", kControls},
                                {"cl_forward", kControls},
                                {"cl_back", kControls},
                                {"look", kControls},
                                {"m_", kControls},
                                {"in_", kControls},
                                {"sens", kControls},
                                {"fov", kScreen},
                                {"view", kScreen},
                                {"scr_", kScreen},
                                {"con_", kScreen},
                                {"cross", kScreen},
                                {"cl_bob", kScreen},
                                {"cl_roll", kScreen},
                                {"v_", kScreen},
                                {"chase_", kScreen},
                                {"gl_cshift", kScreen},
                                {"vid_", kWindow},
                                {"host_", kWindow},
                                {"r_cpu", kWindow},
                                {"r_frames", kWindow},
                                {"sys_", kWindow},
                                {"r_entlights", kEmission},
                                {"r_ambient", kEmission},
                                {"r_light", kEmission},
                                {"r_", kPicture},
                                {"gl_", kPicture},
                                {"volume", kSound},
                                {"bgm", kSound},
                                {"snd_", kSound},
                                {"_snd", kSound},
                                {"ambient_", kSound},
                                {"nosound", kSound},
                                {"s_", kSound},
                                {"sv_", kGame},
                                {"_cl_", kGame},
                                {"cl_", kGame},
                                {"host", kGame},
                                {"net_", kGame},
                                {"coop", kGame},
                                {"death", kGame}};

Page group_page(const Sources& sources, const std::string& group) {
  Page page;
  page.title = group;
  page.plaque = false;
  page.searchable = true;
  page.value_column = 0.56f;
  page.rows = setting_rows(sources.console, group);
  page.empty = "There are no such settings.";
  return page;
}

std::vector<PageInfo> make_list() {
  std::vector<PageInfo> list = {
      {"main", "", "menu_main", main_page},
      {"singleplayer", "main", "menu_singleplayer", single_player_page},
      {"singleplayer/new", "singleplayer", "", new_game_page},
      {"load", "singleplayer", "menu_load", load_page},
      {"save", "singleplayer", "menu_save", save_page},
      {"dead", "", "", dead_page},
      {"maps", "singleplayer", "menu_maps", maps_page},
      {"demos", "main", "menu_demos", demos_page},
      {"mods", "main", "menu_mods", mods_page},
      {"multiplayer", "main", "menu_multiplayer", multiplayer_page},
      {"multiplayer/join", "multiplayer", "", join_page},
      {"multiplayer/host", "multiplayer", "", host_page},
      {"multiplayer/host/map", "multiplayer/host", "", host_map_page},
      {"setup", "multiplayer", "menu_setup", setup_page},
      {"options", "main", "menu_options", options_page},
      {"keys", "options", "menu_keys", keys_page},
      {"video", "options", "menu_video", video_page},
      {"sound", "options", "menu_sound", sound_page},
      {"settings", "options", "menu_settings", settings_page},
      {"settings/all", "settings", "", all_settings_page},
      {"help", "main", "menu_help", help_page},
      {"credits", "main", "menu_credits", credits_page},
      {"quit", "main", "menu_quit", quit_page},
  };
  return list;
}

std::vector<const con::Cvar*> archived(const con::Console& console) {
  std::vector<const con::Cvar*> list = console.cvars();
  std::erase_if(list,
                [](const con::Cvar* cvar) { return !cvar->archived() || (cvar->spec().flags & con::kCvarRom) != 0; });
  return list;
}

}  // namespace

const std::vector<PageInfo>& page_list() {
  static const std::vector<PageInfo> list = make_list();
  return list;
}

const PageInfo* find_page(std::string_view name) {
  const auto found = std::ranges::find_if(page_list(), [&](const PageInfo& info) { return name == info.name; });
  if (found != page_list().end()) return &*found;
  constexpr std::string_view kOfGroups = "settings/";
  if (!name.starts_with(kOfGroups)) return nullptr;
  static std::map<std::string, PageInfo, std::less<>> groups;  // as they are asked for
  const auto [page, is_new] = groups.try_emplace(std::string(name));
  if (is_new)
    page->second = {page->first.c_str(), "settings", "",
                    [group = std::string(name.substr(kOfGroups.size()))](const Sources& sources) {
                      return group_page(sources, group);
                    }};
  return &page->second;
}

std::string_view setting_group(const con::Cvar& cvar) {
  if (!cvar.has_effect()) return kOtherEngines;
  if (!cvar.spec().group.empty()) return cvar.spec().group;
  for (const Prefix& prefix : kPrefixes) {
    if (con::name_starts_with(cvar.name(), prefix.begins)) return prefix.group;
  }
  return kOthers;
}

std::vector<std::string> setting_groups(const con::Console& console) {
  const auto cvars = archived(console);
  std::vector<std::string> groups;
  const auto add = [&](std::string_view group) {
    if (std::ranges::find(groups, group) == groups.end()) groups.emplace_back(group);
  };
  for (const std::string_view group : kGroups) {
    if (std::ranges::any_of(cvars, [&](const con::Cvar* cvar) { return setting_group(*cvar) == group; })) add(group);
    if (group != kBeforeOwn) continue;
    for (const con::Cvar* cvar : cvars)
      if (!cvar->spec().group.empty() && cvar->has_effect()) add(cvar->spec().group);
  }
  return groups;
}

Row setting_row(const con::Cvar& cvar, std::string label, Control control) {
  Row row;
  row.kind = Row::Kind::kSetting;
  row.label = label.empty() ? cvar.name() : std::move(label);
  row.control = std::move(control);
  row.enabled = cvar.has_effect();
  row.help = row.label == cvar.name() ? cvar.spec().help : cvar.name() + ": " + cvar.spec().help;
  row.help += "\ndefault " + (cvar.default_string().empty() ? "empty" : cvar.default_string());
  if (const std::string range = cvar.range_text(); !range.empty()) row.help += "; " + range;
  return row;
}

Row setting_row(const con::Cvar& cvar, std::string label) {
  return setting_row(cvar, std::move(label), control_of(cvar));
}

std::vector<Row> setting_rows(const con::Console& console, std::string_view group) {
  std::vector<Row> rows;
  const auto cvars = archived(console);
  for (const std::string& name : setting_groups(console)) {
    if (!group.empty() && group != name) continue;
    bool first = group.empty();
    for (const con::Cvar* cvar : cvars) {
      if (setting_group(*cvar) != name) continue;
      if (std::exchange(first, false)) {
        Row heading;
        heading.kind = Row::Kind::kHeading;
        heading.label = name;
        rows.push_back(std::move(heading));
      }
      rows.push_back(setting_row(*cvar));
    }
  }
  return rows;
}

bool holds(const Row& row, std::string_view filter) {
  std::size_t start = 0;
  while (start < filter.size()) {
    const std::size_t end = std::min(filter.find(' ', start), filter.size());
    const std::string_view word = filter.substr(start, end - start);
    if (!con::name_contains(row.label, word) && !con::name_contains(row.value, word) &&
        !con::name_contains(row.help, word))
      return false;
    start = end + 1;
  }
  return true;
}

}  // namespace fb::ui::menu
