// The maps of the game's folders with what menus show of them. Only headers and entity lumps are read, a few maps at a
// time, so that a folder of hundreds costs no frame much.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "fs/filesystem.h"
#include "ui/menu/facts.h"

namespace fb::host {

// What a map's entity lump says: its title (worldspawn's "message"), whether a player can start there, and whether it
// has places that choose the skill. Nothing in it can fail.
struct MapSummary {
  std::string title;
  bool playable = false, chooses_skill = false;
};
MapSummary summarise_entities(std::string_view entities);
// The same of the file maps/NAME.bsp. Fails where it cannot be read or is no map.
Result<MapSummary> read_map_summary(const fs::FileSystem& files, std::string_view name);

class MapList {
 public:
  explicit MapList(const fs::FileSystem& files) : files_(files) {}

  // Every map by name, with the titles that are known; those that nobody can play are left out as they are found. The
  // first call finds the files. A map that cannot be read says so in its title.
  const std::vector<ui::menu::MapEntry>& maps();
  // The maps whose name has "start" in it, complete.
  std::vector<ui::menu::MapEntry> start_maps();
  // Reads a few more; true if that changed the list.
  bool read_more();

 private:
  void find();

  const fs::FileSystem& files_;
  std::vector<ui::menu::MapEntry> maps_;
  std::size_t read_ = 0;  // of maps_, complete
  bool found_ = false;
};

}  // namespace fb::host
