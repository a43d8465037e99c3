#include "host/game/map_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/bytes.h"
#include "world/entity_lump.h"

namespace fb::host {
namespace {

constexpr std::string_view kMapFolder = "maps/", kMapExtension = ".bsp";
constexpr std::size_t kMapsAFrame = 8;
constexpr std::size_t kHeader = 12;                    // version, offset and size of the entity lump
constexpr std::uint64_t kMostEntityBytes = 16u << 20;  // as the server takes them

// The text of the first entity, up to the brace outside quotes that closes it.
std::string_view first_entity(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '}' && !quoted) return text.substr(0, i + 1);
  }
  return {};
}

std::string plain_title(std::string_view message) {
  std::string title;
  for (std::size_t i = 0; i < message.size(); ++i) {
    const bool line_break =
        message[i] == '\n' || (message[i] == '\\' && i + 1 < message.size() && message[i + 1] == 'n');
    if (message[i] == '\\' && line_break) ++i;
    if (line_break)
      title += ' ';
    else if (static_cast<unsigned char>(message[i]) >= ' ')
      title += message[i];
  }
  return title;
}

std::uint32_t little_endian(const FileData& data, std::size_t at) {
  const std::uint8_t* bytes = data.data() + at;
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8u |
         static_cast<std::uint32_t>(bytes[2]) << 16u | static_cast<std::uint32_t>(bytes[3]) << 24u;
}

std::string file_of(std::string_view name) { return fmt::format("{}{}{}", kMapFolder, name, kMapExtension); }

}  // namespace

MapSummary summarise_entities(std::string_view entities) {
  MapSummary summary;
  if (const auto world = world::parse_entity_lump(first_entity(entities), "worldspawn"); world && !world->empty())
    summary.title = plain_title(world->front().text("message"));
  summary.playable = entities.find("\"info_player_") != entities.npos;
  summary.chooses_skill = entities.find("\"trigger_setskill\"") != entities.npos;
  return summary;
}

Result<MapSummary> read_map_summary(const fs::FileSystem& files, std::string_view name) {
  const std::string file = file_of(name);
  const auto header = files.load_part(file, 0, kHeader);
  if (!header) return header.error();
  if (header->size() < kHeader) return Error{fmt::format("{}: {} bytes are no map", file, header->size())};
  const std::uint32_t version = little_endian(*header, 0);
  constexpr std::array<std::uint32_t, 4> kVersions = {29, 'B' | 'S' << 8 | 'P' << 16 | '2' << 24,
                                                      '2' | 'P' << 8 | 'S' << 16 | 'B' << 24,
                                                      ' ' | '4' << 8 | '6' << 16 | 'Q' << 24};
  if (std::ranges::find(kVersions, version) == kVersions.end())
    return Error{fmt::format("{}: version {} is none of Quake's maps", file, version)};
  const auto entities = files.load_part(file, little_endian(*header, 4),
                                        std::min<std::uint64_t>(little_endian(*header, 8), kMostEntityBytes));
  if (!entities) return entities.error();
  return summarise_entities(entities->text());
}

void MapList::find() {
  if (found_) return;
  found_ = true;
  for (const fs::FoundFile& file : files_.find(kMapFolder, kMapExtension)) {
    ui::menu::MapEntry map;
    map.name = file.name.substr(kMapFolder.size(), file.name.size() - kMapFolder.size() - kMapExtension.size());
    maps_.push_back(std::move(map));
  }
}

const std::vector<ui::menu::MapEntry>& MapList::maps() {
  find();
  return maps_;
}

std::vector<ui::menu::MapEntry> MapList::start_maps() {
  find();
  std::vector<ui::menu::MapEntry> starts;
  for (const ui::menu::MapEntry& map : maps_) {
    if (map.name.find("start") == map.name.npos) continue;
    const auto summary = read_map_summary(files_, map.name);
    if (summary && summary->playable) starts.push_back({map.name, summary->title, summary->chooses_skill});
  }
  return starts;
}

bool MapList::read_more() {
  if (!found_ || read_ == maps_.size()) return false;
  for (std::size_t count = 0; count < kMapsAFrame && read_ < maps_.size(); ++count) {
    ui::menu::MapEntry& map = maps_[read_];
    const auto summary = read_map_summary(files_, map.name);
    if (summary && !summary->playable) {
      maps_.erase(maps_.begin() + static_cast<std::ptrdiff_t>(read_));
      continue;
    }
    map.title = summary ? summary->title : "(cannot be read)";
    map.chooses_skill = summary && summary->chooses_skill;
    ++read_;
  }
  return true;
}

}  // namespace fb::host
