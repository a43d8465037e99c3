#include "host/base_game.h"

#include <algorithm>
#include <system_error>

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

}  // namespace fb::host
