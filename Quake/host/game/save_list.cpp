#include "host/game/save_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/game/server_list.h"
#include "server/save_game.h"

namespace fb::host {
namespace {

constexpr std::string_view kSaveExtension = ".sav", kKills = "kills:";
constexpr std::size_t kMostSaveBytes = 64u << 20;  // as `load` takes

// A part of the comment: its blanks are written as _.
std::string words_of(std::string_view part) {
  std::string text = plain_text(part);
  std::ranges::replace(text, '_', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

ui::menu::SaveEntry read_entry(const fs::FileSystem& files, const std::string& name) {
  ui::menu::SaveEntry entry;
  entry.name = name;
  const auto data = files.read_own(name + std::string(kSaveExtension));
  return data ? describe_save(name, data->text()) : entry;
}

bool is_slot(std::string_view name) {
  for (int slot = 0; slot < kSaveSlots; ++slot)
    if (name == fmt::format("s{}", slot)) return true;
  return false;
}

}  // namespace

ui::menu::SaveEntry describe_save(std::string_view name, std::string_view text) {
  ui::menu::SaveEntry entry;
  entry.name = name;
  entry.used = true;
  const std::string file = fmt::format("{}{}", name, kSaveExtension);
  if (text.size() > kMostSaveBytes) {
    entry.failure =
        fmt::format("{}: a saved game of {} bytes; at most {} are taken", file, text.size(), kMostSaveBytes);
    return entry;
  }
  const auto save = sv::parse_save(text, file);
  if (!save) {
    entry.failure = save.error().message;
    return entry;
  }
  const std::string& comment = save->header.comment;
  const std::size_t kills = comment.rfind(kKills);
  entry.place = words_of(comment.substr(0, kills));
  if (entry.place.empty()) entry.place = save->header.map;
  if (kills != comment.npos) {
    std::string count = words_of(comment.substr(kills + kKills.size()));
    std::erase(count, ' ');
    entry.kills = std::move(count);
  }
  entry.seconds = save->header.time;
  return entry;
}

std::vector<ui::menu::SaveEntry> list_saves(const fs::FileSystem& files) {
  std::vector<ui::menu::SaveEntry> saves;
  for (int slot = 0; slot < kSaveSlots; ++slot) saves.push_back(read_entry(files, fmt::format("s{}", slot)));
  for (const fs::FoundFile& file : files.find("", kSaveExtension)) {
    const std::string name = file.name.substr(0, file.name.size() - kSaveExtension.size());
    if (name.find('/') != name.npos || is_slot(name)) continue;
    auto entry = read_entry(files, name);
    if (entry.used) saves.push_back(std::move(entry));
  }
  for (const fs::FoundFile& file : files.find("autosave/", kSaveExtension)) {
    auto entry = read_entry(files, file.name.substr(0, file.name.size() - kSaveExtension.size()));
    entry.automatic = true;
    if (entry.used) saves.push_back(std::move(entry));
  }
  return saves;
}

}  // namespace fb::host
