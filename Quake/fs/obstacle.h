// What stands at a path, and why it cannot be read. What is absent is looked for elsewhere; what is there and cannot be
// read (permissions, links to nothing, folders in a file's place) is told from it here, with the system's own words.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace fb::fs {

enum class Standing { kAbsent, kFile, kDirectory, kUnreadable };
struct PathFacts {
  Standing standing = Standing::kAbsent;
  std::string cause;  // why it is no file to be read; empty for a file, and for what is absent
};

// Follows links. kFile: a regular one; whether it opens is not tried.
PathFacts look_at(const std::filesystem::path& path);

// Fails where files in this directory cannot be reached, and where they can but not listed.
Status check_reach(const std::filesystem::path& directory);
Status check_listing(const std::filesystem::path& directory);

// What keeps the file `name` below `directory` from being read: the first thing on the way to it that is there and
// cannot be read. Nullopt where there is no such file, or nothing in its way.
std::optional<Error> find_obstacle(const std::filesystem::path& directory, std::string_view name);

}  // namespace fb::fs
