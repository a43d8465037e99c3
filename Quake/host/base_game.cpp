#include "host/base_game.h"

#include <algorithm>
#include <system_error>

#include "base/log.h"
#include "platform/program_directory.h"

namespace fb::host {

std::filesystem::path find_base_game(const std::filesystem::path& program_directory) {
  for (const auto& place : {program_directory / "game", program_directory / ".." / "share" / "fullbright" / "game"}) {
    std::error_code code;
    if (std::filesystem::is_regular_file(place / "id1" / "progs.dat", code)) return place.lexically_normal();
  }
  return {};
}

std::vector<std::string> with_base_game(std::vector<std::string> arguments) {
  if (std::ranges::find(arguments, "-basegame") != arguments.end()) return arguments;
  const std::filesystem::path found = find_base_game(platform::program_directory());
  if (!found.empty()) arguments.insert(arguments.begin(), {"-basegame", found.string()});
  return arguments;
}

std::vector<std::string> with_store_game(std::vector<std::string> arguments, const std::vector<fs::StoreGame>& games,
                                         const std::filesystem::path& here) {
  const auto given = [&](const char* option) { return std::ranges::find(arguments, option) != arguments.end(); };
  std::error_code code;
  if (given("-basedir") || std::filesystem::is_directory(here / "id1", code)) return arguments;
  const bool steam = given("-steam"), gog = given("-gog"), original = given("-preforiginal") || given("-original");
  std::vector<fs::StoreGame> allowed;
  for (const fs::StoreGame& game : games) {
    const bool is_steams = game.store == "Steam";
    if (given(is_steams ? "-nosteam" : "-nogog") || ((steam || gog) && !(is_steams ? steam : gog))) continue;
    allowed.push_back(game);
  }
  if (allowed.empty()) return arguments;
  const auto wanted = std::ranges::find(allowed, !original, &fs::StoreGame::remaster);
  const fs::StoreGame& game = wanted != allowed.end() ? *wanted : allowed.front();
  log_info("Quake of {} is played, from {}; -nosteam -nogog play the base game", game.store, game.base_dir.string());
  arguments.insert(arguments.begin(), {"-basedir", game.base_dir.string()});
  return arguments;
}

}  // namespace fb::host
