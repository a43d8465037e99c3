// Pages that list what there is: saved games, maps, demos, mods.
#include <fmt/format.h>

#include <utility>

#include "ui/menu/pages.h"
#include "ui/menu/rows.h"

namespace fb::ui::menu {
namespace {

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(seconds < 0.0 || seconds > 1e9 ? 0.0 : seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

Row save_row(const SaveEntry& save) {
  Row row;
  row.label = !save.failure.empty() ? "(cannot be read)" : save.used ? save.place : "- empty -";
  if (save.used && save.failure.empty()) row.value = fmt::format("{:>7}{:>7}", save.kills, clock_text(save.seconds));
  row.help = save.failure.empty() ? save.name + ".sav" : save.failure;
  if (save.used && save.failure.empty()) row.save = save.name;
  return row;
}

Page saves_page(const char* title, const char* picture) {
  Page page;
  page.title = title;
  page.title_picture = picture;
  page.plaque = false;
  page.value_column = 0.65f;
  page.live = true;
  page.save_pictures = true;
  return page;
}

}  // namespace

Page load_page(const Sources& sources) {
  Page page = saves_page("Load", "gfx/p_load.lmp");
  bool automatic = false;
  for (const SaveEntry& save : sources.facts.saves()) {
    if (save.automatic && !std::exchange(automatic, true)) page.rows.push_back(heading("Autosaves"));
    Row row = save_row(save);
    row.enabled = save.used && save.failure.empty();
    row.command = fmt::format("disconnect; maxplayers 1; load {}", con::in_quotes(save.name));
    row.closes = true;
    page.rows.push_back(std::move(row));
  }
  return page;
}

Page save_page(const Sources& sources) {
  Page page = saves_page("Save", "gfx/p_save.lmp");
  if (const std::string reason = sources.facts.reason_not_to_save(); !reason.empty()) {
    page.rows.push_back(heading(reason));
    return page;
  }
  for (const SaveEntry& save : sources.facts.saves()) {
    if (save.automatic) continue;
    Row row = save_row(save);
    row.command = fmt::format("save {}", con::in_quotes(save.name));
    row.closes = true;
    if (save.used) row.question = "Write over this saved game?";
    page.rows.push_back(std::move(row));
  }
  return page;
}

// sv_autoload 1.
Page dead_page(const Sources& sources) {
  Page page = saves_page("You are dead", "");
  const std::string save = sources.facts.save_after_death();
  if (!save.empty()) {
    Row row = action("Load the last save", "load " + con::in_quotes(save), save + ".sav");
    row.save = save;
    row.closes = true;
    page.rows.push_back(std::move(row));
  }
  page.rows.push_back(action("Start the level over", "restart level"));
  page.rows.back().closes = true;
  page.rows.push_back(link("Load another", "load"));
  return page;
}

Page maps_page(const Sources& sources) {
  Page page;
  page.title = "Maps";
  page.plaque = false;
  page.searchable = true;
  page.live = true;
  page.value_column = 0.4f;
  page.empty = "There are no maps.";
  for (const MapEntry& map : sources.facts.maps()) {
    Row row = new_game(sources, map.name, map.name);
    row.value = map.title;
    page.rows.push_back(std::move(row));
  }
  return page;
}

Page demos_page(const Sources& sources) {
  Page page;
  page.title = "Demos";
  page.plaque = false;
  page.searchable = true;
  page.empty = "There are no demos.";
  const bool in_game = sources.facts.in_game();
  for (const std::string& name : sources.facts.demos()) {
    Row row = action(name, "playdemo " + con::in_quotes(name));
    row.closes = true;
    if (in_game) row.question = "Leave this game for the demo?";
    page.rows.push_back(std::move(row));
  }
  return page;
}

namespace {

// What is installed, how the last one ended, and what can be.
void add_installs(const Sources& sources, Page& page) {
  const InstallState state = sources.facts.installing();
  const std::vector<ArchiveEntry> archives = sources.facts.archives();
  page.rows.push_back(heading("Archives"));
  if (!state.going_on.empty()) {
    Row row = action("Installing " + state.going_on, "installmod cancel", "Enter gives it up.");
    row.value = fmt::format("{} %", state.percent);
    row.question = fmt::format("Give up installing {}?", state.going_on);
    page.rows.push_back(std::move(row));
  } else if (!state.failure.empty()) {
    page.rows.push_back(action("Not installed", "", state.failure));
    page.rows.back().value = "(why: below)";
  } else if (!state.installed.empty()) {
    page.rows.push_back(action("Installed", "", fmt::format("{} is in the list now.", state.installed)));
    page.rows.back().value = state.installed;
  }
  for (const ArchiveEntry& archive : archives) {
    const bool sound = archive.failure.empty();
    Row row = action(sound ? (archive.replaces ? "Replace " : "Install ") + archive.mod : archive.name,
                     fmt::format("installmod {}{}", con::in_quotes(archive.name), archive.replaces ? " replace" : ""));
    row.value = sound ? archive.size : "(not for installing)";
    row.help = sound ? fmt::format("{}: {}", archive.name, archive.facts) : archive.failure;
    row.enabled = sound && state.going_on.empty();
    if (archive.replaces) row.question = fmt::format("Replace {}? Saves and settings stay.", archive.mod);
    page.rows.push_back(std::move(row));
  }
  if (!archives.empty()) return;
  page.rows.push_back(action("Install a mod", "", "Put its .zip into " + state.folder));
  page.rows.back().enabled = false;
}

}  // namespace

Page mods_page(const Sources& sources) {
  Page page;
  page.title = "Mods";
  page.plaque = false;
  page.searchable = true;
  page.value_column = 0.4f;
  page.live = true;
  const bool in_game = sources.facts.in_game();
  for (const ModEntry& mod : sources.facts.mods()) {
    Row row = action(mod.directory, "game " + con::in_quotes(mod.directory));
    row.value = mod.active ? "(is played)" : mod.description;
    row.help = mod.description;
    row.closes = true;
    row.enabled = !mod.active;
    if (in_game) row.question = "Leave this game? The program starts again.";
    page.rows.push_back(std::move(row));
  }
  add_installs(sources, page);
  return page;
}

}  // namespace fb::ui::menu
