// Where files are looked for: a pak, an archive, or a folder of loose files.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "fs/file.h"
#include "fs/filesystem.h"
#include "fs/pak.h"
#include "fs/zip.h"

namespace fb::fs {

struct Place {
  std::string label;  // FileSystem::source_of
  int game_index = 0;
  std::unique_ptr<Pak> pak;
  std::unique_ptr<Zip> zip;
  std::filesystem::path directory;  // where there is neither

  bool packed() const { return pak || zip; }
  const std::vector<PakEntry>& entries() const { return pak ? pak->entries() : zip->entries(); }
  const PakEntry* find(std::string_view name) const { return pak ? pak->find(name) : zip->find(name); }
  const PakEntry* find_ignoring_case(std::string_view name) const {
    return pak ? pak->find_ignoring_case(name) : zip->find_ignoring_case(name);
  }
  Result<FileData> read(const PakEntry& entry) const { return pak ? pak->read(entry) : zip->read(entry); }
};

struct Hit {
  const Place* place = nullptr;
  const PakEntry* entry = nullptr;  // of the place, if it is packed
  std::filesystem::path path;       // of a loose file

  Result<FileData> read() const { return entry != nullptr ? place->read(*entry) : read_whole_file(path); }
};

using ListedFiles = std::map<std::string, FoundFile>;  // by name

// What find() looks for.
struct Pattern {
  std::string prefix;  // lower case
  std::string_view extension;

  bool file(std::string_view name) const;
  // Can there be such a file below this directory ("maps/")?
  bool directory(std::string_view name) const;
};

// Adds what the pattern asks for of the loose files in a directory and below it.
void add_loose_files(const std::filesystem::path& directory, const Place& place, const Pattern& pattern,
                     ListedFiles& files);

}  // namespace fb::fs
