// Quake where stores put it: Steam in its libraries, GOG's and Heroic's games below the player's home.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fb::fs {

struct StoreGame {
  std::filesystem::path base_dir;  // holds id1, whatever its case
  std::string store;               // "Steam", "GOG"
  bool remaster = false;           // the re-release of 2021
};

// All below a player's home, Steam's first, of each place the re-release before the original. Folders that cannot be
// read are as if they were not there.
std::vector<StoreGame> find_store_games(const std::filesystem::path& home);

// The folders that Steam's libraryfolders.vdf names ("path" and a text in quotes, \\ for \), in their order.
std::vector<std::filesystem::path> steam_libraries(std::string_view vdf);

}  // namespace fb::fs
