#include "ui/menu/pages.h"

#include <algorithm>

namespace fb::ui::menu {
namespace {

constexpr const char* kGroups[] = {"Controls", "Game pads", "Screen",   "Window and speed",
                                   "Picture",  "Light",     "Denoiser", "Guiding",
                                   "Sound",    "Game",      "Others",   "Other engines"};

// The first row whose words begin the cvar's name says where it belongs.
struct Prefix {
  std::string_view begins;
  int group;  // in kGroups
};
constexpr Prefix kPrefixes[] = {
    {"joy_", 1},    {"cl_alwaysrun", 0}, {"cl_max", 0},    {"cl_min", 0},   {"cl_forward", 0},  {"cl_back", 0},
    {"look", 0},    {"m_", 0},           {"in_", 0},       {"sens", 0},     {"fov", 2},         {"view", 2},
    {"scr_", 2},    {"con_", 2},         {"cross", 2},     {"cl_bob", 2},   {"cl_roll", 2},     {"v_", 2},
    {"chase_", 2},  {"gl_cshift", 2},    {"vid_", 3},      {"host_", 3},    {"r_cpu", 3},       {"r_frames", 3},
    {"r_scale", 3}, {"sys_", 3},         {"r_mc_", 7},     {"r_guide", 7},  {"r_svgf", 6},      {"r_denoise", 6},
    {"r_acc", 6},   {"r_taa", 6},        {"r_fxaa", 6},    {"r_emit", 5},   {"r_entlights", 5}, {"r_ambient", 5},
    {"r_light", 5}, {"r_nee", 5},        {"r_bounces", 5}, {"r_spp", 5},    {"r_first_spp", 5}, {"r_estim", 5},
    {"r_", 4},      {"gl_", 4},          {"gamma", 4},     {"contrast", 4}, {"volume", 8},      {"bgm", 8},
    {"snd_", 8},    {"_snd", 8},         {"ambient_", 8},  {"nosound", 8},  {"s_", 8},          {"sv_", 9},
    {"_cl_", 9},    {"cl_", 9},          {"host", 9},      {"net_", 9},     {"coop", 9},        {"death", 9}};
constexpr int kOthers = 10, kOtherEngines = 11;

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
  static std::vector<std::string> names;  // PageInfo only points
  names.reserve(std::size(kGroups));
  for (const char* group : kGroups) {
    names.push_back(std::string("settings/") + group);
    list.push_back({names.back().c_str(), "settings", "", [group](const Sources& sources) {
                      Page page;
                      page.title = group;
                      page.plaque = false;
                      page.searchable = true;
                      page.value_column = 0.56f;
                      page.rows = setting_rows(sources.console, group);
                      return page;
                    }});
  }
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
  return found == page_list().end() ? nullptr : &*found;
}

std::string_view setting_group(const con::Cvar& cvar) {
  if (!cvar.has_effect()) return kGroups[kOtherEngines];
  for (const Prefix& prefix : kPrefixes) {
    if (con::name_starts_with(cvar.name(), prefix.begins)) return kGroups[prefix.group];
  }
  return kGroups[kOthers];
}

std::vector<std::string> setting_groups(const con::Console& console) {
  std::vector<std::string> groups;
  const auto cvars = archived(console);
  for (const std::string_view group : kGroups) {
    if (std::ranges::any_of(cvars, [&](const con::Cvar* cvar) { return setting_group(*cvar) == group; }))
      groups.emplace_back(group);
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
  for (const std::string_view name : kGroups) {
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
