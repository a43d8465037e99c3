#include "fs/options.h"

#include <fmt/format.h>

#include <algorithm>

#include "fs/path.h"

namespace fb::fs {
namespace {

void add_once(std::vector<std::string>& games, const std::string& game) {
  const auto same = [&](const std::string& other) { return lower_case(other) == lower_case(game); };
  if (!same("id1") && std::none_of(games.begin(), games.end(), same)) games.push_back(game);
}

}  // namespace

Result<FsOptions> options_from_arguments(std::span<const std::string> arguments) {
  FsOptions options;
  const auto given = [&](const char* flag) {
    return std::find(arguments.begin(), arguments.end(), flag) != arguments.end();
  };
  // If there are several, QuakeSpasm's order is used, whatever their order on the command line.
  for (const char* pack : {"rogue", "hipnotic", "quoth"}) {
    if (given(fmt::format("-{}", pack).c_str())) add_once(options.games, pack);
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "-nohome") options.user_dir = std::filesystem::path();
    const bool game = arguments[i] == "-game", user = arguments[i] == "-userdir", box = arguments[i] == "-basegame";
    if (!game && !user && !box && arguments[i] != "-basedir") continue;
    if (i + 1 == arguments.size()) return Error{fmt::format("{} needs a directory after it", arguments[i])};
    const std::string& value = arguments[++i];
    if (game) {
      if (!is_game_name(value))
        return Error{fmt::format("-game \"{}\": a gamedir is one directory's name below -basedir, not a path", value)};
      add_once(options.games, value);
    } else {
      if (value.empty()) return Error{fmt::format("{} needs a directory after it", arguments[i - 1])};
      if (user) {
        options.user_dir = value;
      } else if (box) {
        options.base_game = value;
      } else {
        options.base_dir = value;
        options.base_dir_named = true;
      }
    }
  }
  return options;
}

}  // namespace fb::fs
