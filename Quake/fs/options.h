// Where game data is, as the command line says it: -basedir DIR, -userdir DIR, -nohome, -basegame DIR, -game DIR,
// -hipnotic, -rogue, -quoth.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace fb::fs {

struct FsOptions {
  std::filesystem::path base_dir = ".";
  bool base_dir_named = false;  // by the user; if not, and base_dir has no id1, base_game takes its place
  // The game in the box: base_game/id1. It is searched last of all where nothing else has a progs.dat, so that data
  // without game code of its own can be played. Empty: none.
  std::filesystem::path base_game;
  std::vector<std::string> games;  // after id1, mission packs first, each once; later ones win
  // What the player writes, and what he adds: DIR/<gamedir> is searched before <base_dir>/<gamedir>. nullopt:
  // default_user_dir(); an empty path: none, and writing goes below base_dir.
  std::optional<std::filesystem::path> user_dir;
};

// QuakeSpasm's command line. Every -game counts, in order; mission packs come before them. Arguments that are not about
// files are passed over. Fails on an option without its value and on a gamedir that is a path.
Result<FsOptions> options_from_arguments(std::span<const std::string> arguments);

// $XDG_DATA_HOME/fullbright where that is set, else ~/.fullbright; empty where there is no home, and on Windows, where
// games write beside their data. It need not exist.
std::filesystem::path default_user_dir();

}  // namespace fb::fs
