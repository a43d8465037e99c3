// Finds out why a path cannot be read. An absent file is searched for elsewhere; one that exists and cannot be read
// (permissions, broken links, a folder in the place of a file) is reported, with the system's error text.
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
  std::string cause;  // why it is not a readable file; empty for a file, and if it does not exist
};

// Follows links. kFile: a regular one; whether it opens is not tried.
PathFacts look_at(const std::filesystem::path& path);

// Fails if files in this directory cannot be reached, or can be reached but not listed.
Status check_reach(const std::filesystem::path& directory);
Status check_listing(const std::filesystem::path& directory);

// The reason why the file `name` below `directory` cannot be read: the first part of its path that exists and cannot be
// read. Nullopt if there is no such file, or nothing prevents reading it.
std::optional<Error> find_obstacle(const std::filesystem::path& directory, std::string_view name);

}  // namespace fb::fs
