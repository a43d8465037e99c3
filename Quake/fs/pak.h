// PAK archives: a header of twelve bytes ("PACK", offset and size of the directory), then files, then directory entries
// of 64 bytes (56 of name, offset, size). The directory is read once and files when they are needed, so opening a pak
// of a gigabyte costs its directory only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "fs/file.h"

namespace fb::fs {

struct PakEntry {
  std::string name;          // as the pak spells it, with forward slashes
  std::uint64_t offset = 0;  // bytes from the pak's start
  std::uint32_t size = 0;    // bytes; offset + size lies inside the file
};

constexpr std::size_t kPakHeaderSize = 12;
constexpr std::size_t kPakEntrySize = 64;
constexpr std::size_t kPakNameSize = 56;
constexpr std::size_t kMostPakEntries = 1u << 18u;  // Quake had 2048, the largest mods ten thousand

// Of a directory: entries that do not lie inside the file are left out, and named in one sentence.
struct PakDirectory {
  std::vector<PakEntry> entries;
  std::string warning;  // empty: none was left out
};

struct PakHeader {
  std::uint32_t directory_offset = 0, directory_size = 0;  // bytes, inside the file
};

// The two steps of opening a pak; `file_size` is that of the whole pak. Errors name the pak, the offset and the cause.
Result<PakHeader> parse_pak_header(ByteView header, std::uint64_t file_size, std::string_view name);
PakDirectory parse_pak_directory(ByteView directory, const PakHeader& header, std::uint64_t file_size,
                                 std::string_view name);
// Both steps, for a pak in memory.
Result<PakDirectory> parse_pak(ByteView data, std::string_view name);

class Pak {
 public:
  // `name` is the pak's name in errors, e.g. "id1/pak0.pak". What is left out of it goes to the log.
  static Result<Pak> open(const std::filesystem::path& path, std::string name);

  const std::string& name() const { return name_; }
  const std::vector<PakEntry>& entries() const { return entries_; }
  // Of two entries with one name the first is used, as in Quake. nullptr: none.
  const PakEntry* find(std::string_view name) const;
  // The same without regard to case.
  const PakEntry* find_ignoring_case(std::string_view name) const;
  // The entry's bytes.
  Result<FileData> read(const PakEntry& entry) const;

 private:
  Pak(RandomAccessFile file, std::string name, std::vector<PakEntry> entries);

  RandomAccessFile file_;
  std::string name_;
  std::vector<PakEntry> entries_;
  std::map<std::string, std::size_t, std::less<>> by_name_, by_lower_name_;
};

}  // namespace fb::fs
