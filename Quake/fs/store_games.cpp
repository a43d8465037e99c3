#include "fs/store_games.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "fs/directory_index.h"
#include "fs/file.h"

namespace fb::fs {
namespace {

namespace stdfs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 1 << 20;  // of a list of libraries; more is none
// Steam's own folder, by how it was installed: Valve's package, Flatpak, Snap.
constexpr const char* kSteam[] = {".steam/steam",
                                  ".steam/root",
                                  ".local/share/Steam",
                                  ".var/app/com.valvesoftware.Steam/.local/share/Steam",
                                  ".var/app/com.valvesoftware.Steam/data/Steam",
                                  "snap/steam/common/.local/share/Steam"};
// Of GOG's game, by Heroic, by Lutris and by Wine with GOG's installer.
constexpr const char* kGog[] = {"Games/Heroic/Quake", "Games/Heroic/Quake The Offering",
                                "Games/quake/drive_c/GOG Games/Quake", "GOG Games/Quake",
                                ".wine/drive_c/GOG Games/Quake"};

bool holds_quake(const stdfs::path& folder) {
  DirectoryIndex index;
  const auto pak = index.find(folder, "id1/pak0.pak");
  std::error_code code;
  return pak && stdfs::is_regular_file(folder / *pak, code);
}

void add_games(std::vector<StoreGame>& games, const stdfs::path& folder, const std::string& store) {
  for (const bool remaster : {true, false}) {
    const stdfs::path base = remaster ? folder / "rerelease" : folder;
    std::error_code code;
    const auto same = [&](const StoreGame& game) { return stdfs::equivalent(game.base_dir, base, code); };
    if (holds_quake(base) && std::ranges::none_of(games, same)) games.push_back({base, store, remaster});
  }
}

std::string small_text(const stdfs::path& path) {
  std::error_code code;
  const std::uintmax_t size = stdfs::file_size(path, code);
  if (code || size > kMostBytes) return {};
  const auto data = read_whole_file(path);
  return data ? std::string(data->begin(), data->end()) : std::string();
}

}  // namespace

std::vector<stdfs::path> steam_libraries(std::string_view vdf) {
  std::vector<stdfs::path> libraries;
  std::optional<std::string> key;  // whose value, or block in braces, comes next
  for (std::size_t i = 0; i < vdf.size(); ++i) {
    if (vdf[i] == '{' || vdf[i] == '}') key.reset();
    if (vdf[i] != '"') continue;
    std::string text;
    for (++i; i < vdf.size() && vdf[i] != '"'; ++i) {
      if (vdf[i] == '\\' && i + 1 < vdf.size()) ++i;
      text += vdf[i];
    }
    if (!key) {
      key = std::move(text);
      continue;
    }
    if (*key == "path" && !text.empty()) libraries.emplace_back(text);
    key.reset();
  }
  return libraries;
}

std::vector<StoreGame> find_store_games(const stdfs::path& home) {
  std::vector<StoreGame> games;
  for (const char* place : kSteam) {
    const stdfs::path steam = home / place;
    std::vector<stdfs::path> libraries = steam_libraries(small_text(steam / "steamapps" / "libraryfolders.vdf"));
    libraries.insert(libraries.begin(), steam);
    for (const stdfs::path& library : libraries) add_games(games, library / "steamapps" / "common" / "Quake", "Steam");
  }
  for (const char* place : kGog) add_games(games, home / place, "GOG");
  return games;
}

}  // namespace fb::fs
