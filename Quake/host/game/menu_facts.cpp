#include "host/game/menu_facts.h"

#include <utility>

#include "host/game/mod_list.h"
#include "host/options.h"
#include "host/game/presets.h"
#include "host/game/save_list.h"
#include "host/game/save_picture.h"
#include "platform/keys.h"

namespace fb::host {
namespace {

constexpr uvec2 kSizes[] = {{640, 360},   {640, 480},   {800, 600},   {960, 540},   {1024, 768},
                            {1280, 720},  {1280, 800},  {1366, 768},  {1600, 900},  {1920, 1080},
                            {1920, 1200}, {2560, 1440}, {2560, 1600}, {3440, 1440}, {3840, 2160}};

}  // namespace

void MenuFacts::update() {
  bool changed = maps_.read_more();
  while (reads_at_once_ && maps_.read_more()) {}
  const ServerList& list = engine_.server_list();
  if (list.searching() != searching_ || list.found().size() != servers_) {
    searching_ = list.searching();
    servers_ = list.found().size();
    changed = true;
  }
  const std::uint64_t installs = engine_.mod_installer().revision();
  if (std::exchange(installs_, installs) != installs) changed = true;
  if (changed) ++revision_;
}

bool MenuFacts::in_game() const { return engine_.client().connected() && !engine_.client().playing(); }

std::string MenuFacts::reason_not_to_save() const {
  const auto reason = engine_.server().reason_not_to_save();
  return reason ? reason->message : std::string();
}

std::vector<ui::menu::SaveEntry> MenuFacts::saves() { return list_saves(engine_.files()); }

std::optional<formats::RgbaImage> MenuFacts::save_picture(const std::string& name) {
  return read_save_picture(engine_.files(), name);
}

std::vector<std::string> MenuFacts::demos() {
  std::vector<std::string> names;
  for (const fs::FoundFile& file : engine_.files().find("", ".dem"))
    names.push_back(file.name.substr(0, file.name.size() - 4));
  return names;
}

std::vector<ui::menu::ModEntry> MenuFacts::mods() { return list_mods(engine_.files()); }

std::vector<ui::menu::ServerEntry> MenuFacts::servers() {
  std::vector<ui::menu::ServerEntry> servers;
  for (const net::FoundServer& server : engine_.server_list().found()) {
    servers.push_back({plain_text(server.name), plain_text(server.map), server.address.to_string(), server.players,
                       server.max_players, server.compatible});
  }
  return servers;
}

std::vector<uvec2> MenuFacts::video_sizes() {
  const uvec2 display = display_size_ ? display_size_() : uvec2(0);
  std::vector<uvec2> sizes;
  for (const uvec2& size : kSizes)
    if (display.x == 0 || (size.x <= display.x && size.y <= display.y)) sizes.push_back(size);
  if (display.x != 0 && (sizes.empty() || sizes.back() != display)) sizes.push_back(display);
  return sizes;
}

std::vector<ui::menu::PresetEntry> MenuFacts::presets() const {
  std::vector<ui::menu::PresetEntry> entries;
  for (const Preset& preset : host::presets()) entries.push_back({preset.name, preset.purpose});
  return entries;
}

std::string MenuFacts::preset() const {
  const Preset* now = preset_in_force(engine_.console());
  return now ? now->name : "";
}

std::string MenuFacts::key_name(int key) const { return platform::key_name(key); }
std::string MenuFacts::version() const { return version_text(); }

}  // namespace fb::host
