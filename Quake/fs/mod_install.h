// Unpacks a mod's archive (fs/mod_archive.h) into the player's folder. It grows beside its place in a folder with a
// name of its own and is renamed at the end, so that a full disk, a damaged archive or a kill leaves what was there
// before; what a killed program has left is removed as temporary files are (fs/temporary_file.h).
//
// Of a mod that is replaced go its programs, its paks and archives, and the files that the new one has; what the player
// and the game have put beside them stays: saves and settings in any case, maps that the new one does not have.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "fs/mod_archive.h"

namespace fb::fs {

struct ModPlace {
  std::filesystem::path folder;               // the mod's folder is made in it
  std::vector<std::filesystem::path> others;  // where games are looked for, too: a mod that is there is not doubled
};

enum class Existing { kRefuse, kReplace };

// Told of the bytes that are unpacked so far; false: give it up. Called at least once for each MiB and once a file.
using InstallProgress = std::function<bool(std::uint64_t bytes)>;

// Whether a folder holds a pak0.pak, a pk3, a progs.dat or maps.
bool holds_game_data(const std::filesystem::path& folder);

// The folder in `place` that this mod has, in any case of letters; empty if there is none.
std::filesystem::path installed_mod(const std::filesystem::path& place, std::string_view folder);

// Why it cannot be installed, before anything is unpacked: a mod of its name is there, in one of the others or by a
// link, or there is less free space than it takes.
Status may_install(const ModPlan& plan, const ModPlace& place, Existing existing);

// Returns the mod's folder. Fails by one sentence and leaves all as it was.
Result<std::filesystem::path> install_mod(const ModArchive& archive, const ModPlace& place, Existing existing,
                                          const InstallProgress& progress);

// What becomes of a file in the folder of a mod that is replaced.
enum class Kept {
  kNo,      // a program, a pak or an archive: the new one's alone count
  kUnless,  // the new one has a file of its name
  kAlways   // in the place of the new one's
};
Kept kept_file(std::string_view name);

}  // namespace fb::fs
