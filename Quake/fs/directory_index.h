// The contents of a directory by lower-case name, for data made on systems that ignore case. A listing is cached until
// the directory changes, so that the many names that no directory has (replacement textures) cost a look-up each, not a
// scan.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <functional>

namespace fb::fs {

// Safe to use from several threads.
class DirectoryIndex {
 public:
  // The path below `root` that equals `name` except for case, e.g. "Maps/START.bsp"; nullopt if there is none. Of
  // several matches the first in sorted order is used.
  std::optional<std::string> find(const std::filesystem::path& root, std::string_view name);

 private:
  struct Listing {
    std::filesystem::file_time_type changed;
    std::map<std::string, std::string, std::less<>> names;  // lower case to real
  };
  const Listing* listing(const std::filesystem::path& directory);

  std::mutex mutex_;
  std::map<std::string, Listing> listings_;
};

}  // namespace fb::fs
