// ZIP archives: pk3, and the 2021 re-release's kpf. Read by libzip; what is trusted is decided here. The list of files
// is read once and files when they are needed. Files may be stored or deflated, as other engines have them.
//
// An archive is refused as a whole only if there is no list to read. A file in it is left out if its name is none that
// a game may have (fs/path.h) or is there already, if it is encrypted or packed by another method, or if it claims a
// size that its bytes cannot unpack to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file_data.h"
#include "base/result.h"
#include "fs/pak.h"

struct zip;

namespace fb::fs {

constexpr std::size_t kMostZipEntries = kMostPakEntries;
constexpr std::uint64_t kMostZipFile = 512u << 20u;  // bytes of one file, unpacked
constexpr std::size_t kMostArchives = 256;           // of a gamedir; each stays open

// Reading is safe from several threads; they read one after the other.
class Zip {
 public:
  // `name` is the archive's name in errors, e.g. "id1/pak0.pk3".
  static Result<std::unique_ptr<Zip>> open(const std::filesystem::path& path, std::string name);
  // One in memory.
  static Result<std::unique_ptr<Zip>> open(FileData data, std::string name);
  ~Zip();
  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;

  const std::string& name() const { return name_; }
  // PakEntry::offset is the file's number in the archive.
  const std::vector<PakEntry>& entries() const { return entries_; }
  const PakEntry* find(std::string_view name) const;
  const PakEntry* find_ignoring_case(std::string_view name) const;
  // The file's bytes; a part of them is unpacked from the file's start on, but its checksum is not checked.
  Result<FileData> read(const PakEntry& entry) const { return read(entry, 0, entry.size); }
  Result<FileData> read(const PakEntry& entry, std::uint64_t offset, std::uint64_t most) const;

  // What was left out, for people: "2 of 30 files are left out; the first is "../x": ..."; empty if nothing was.
  const std::string& left_out() const { return left_out_; }

 private:
  Zip(::zip* archive, FileData data, std::string name)
      : archive_(archive), data_(std::move(data)), name_(std::move(name)) {}
  Status list(std::uint64_t archive_size);
  static Result<std::unique_ptr<Zip>> finish(std::unique_ptr<Zip> zip, std::uint64_t archive_size);
  Error error(const PakEntry& entry, std::string_view cause) const;

  mutable std::mutex mutex_;  // of archive_
  ::zip* archive_;
  FileData data_;
  std::string name_, left_out_;
  std::vector<PakEntry> entries_;
  std::map<std::string, std::size_t, std::less<>> by_name_, by_lower_name_;
};

// A gamedir's archives (*.pk3) by name, ignoring case. `label` is the gamedir's name in errors, "id1". What cannot be
// read is warned of and left out: QuakeSpasm does not know archives, so the game may play without.
std::vector<std::unique_ptr<Zip>> open_archives(const std::filesystem::path& directory, const std::string& label);

}  // namespace fb::fs
