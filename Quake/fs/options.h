// The command line's options about game data: -basedir DIR, -userdir DIR, -nohome, -basegame DIR, -game DIR, -hipnotic,
// -rogue, -quoth.
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
  // Folder that holds the base game's id1. It is searched last, and only if nothing else has a progs.dat, so that data
  // without game code of its own can be played. Empty: none.
  std::filesystem::path base_game;
  std::vector<std::string> games;  // after id1, mission packs first, each once; later ones take precedence
  // Folder for files that the player writes or adds: DIR/<gamedir> is searched before <base_dir>/<gamedir>. nullopt:
  // default_user_dir(); an empty path: none, and files are written below base_dir.
  std::optional<std::filesystem::path> user_dir;
};

// Reads QuakeSpasm's command line. Every -game applies, in order; mission packs come before them. Arguments that are
// not about files are ignored. Fails on an option without its value and on a gamedir that is a path.
Result<FsOptions> options_from_arguments(std::span<const std::string> arguments);

// $HOME or, if that names no folder, what the system's list of users has; empty if there is neither, and on Windows.
std::filesystem::path home_directory();

// $XDG_DATA_HOME/fullbright if that is set, else ~/.fullbright. Empty if there is neither, and on Windows, where games
// write beside their data. It need not exist.
std::filesystem::path default_user_dir();
// Whether it is this system's way that games write beside their data.
bool plays_beside_data();

}  // namespace fb::fs
