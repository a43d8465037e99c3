// A mod's archive (.zip) as it is handed out, read before anything of it is unpacked: which folder it makes, which
// files come into it, how large they are. An archive comes from strangers, so it is refused as a whole, by one
// sentence, where any of its entries is
//   - named by an absolute path, "..", a drive, a backslash, or what some system takes for no plain name (CON, "a.",
//   "?");
//   - named twice, also in another case, or as a file and as a folder;
//   - a link or a device; encrypted, or packed otherwise than stored and deflated;
//   - larger than ModLimits, or said to hold more than its packed bytes can; or where entries share packed bytes.
//
// The mod is what lies at the archive's top, or in the one folder that has game data (a progs.dat, a pak0.pak, a pk3 or
// maps/), which may itself lie in folders. What lies outside of it is left out; so are names of letters beyond ASCII,
// which no game asks for, and what systems put into archives on their own (__MACOSX, names with a dot first).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"

struct zip;

namespace fb::fs {

struct ModLimits {
  std::size_t entries = 65536;
  std::uint64_t bytes = 8ull << 30u;       // of all files, unpacked
  std::uint64_t file_bytes = 2ull << 30u;  // of one: a pak has no more
  // All files to the archive's size, where they are more than ratio_from bytes. Maps shrink to a fifth.
  std::uint64_t ratio = 100, ratio_from = 64u << 20u;
};

struct PlannedFile {
  std::string name;         // below the mod's folder: "maps/start.bsp"
  std::uint64_t index = 0;  // in the archive
  std::uint64_t size = 0;   // bytes, unpacked
};

struct ModPlan {
  std::string folder;  // the mod's: lower case, "ad"
  std::vector<PlannedFile> files;
  std::uint64_t bytes = 0;  // of all files
  std::string left_out;     // for people: how many files, and the first one; empty: none
};

class ModArchive {
 public:
  // Reads the list and plans. Fails with one sentence that begins with the archive's file name.
  static Result<std::unique_ptr<ModArchive>> open(const std::filesystem::path& path, const ModLimits& limits = {});
  // One in memory; `name` is its file name.
  static Result<std::unique_ptr<ModArchive>> open(FileData data, std::string name, const ModLimits& limits = {});
  ~ModArchive();
  ModArchive(const ModArchive&) = delete;
  ModArchive& operator=(const ModArchive&) = delete;

  const std::string& name() const { return name_; }
  const ModPlan& plan() const { return plan_; }
  // Gives the file's bytes to `take`, in parts of at most 1 MiB; its error ends the reading. Fails where the archive is
  // damaged: the size or the checksum is another one. Not from several threads at once.
  Status read(const PlannedFile& file, const std::function<Status(ByteView part)>& take) const;

 private:
  ModArchive(::zip* archive, FileData data, std::string name)
      : archive_(archive), data_(std::move(data)), name_(std::move(name)) {}
  static Result<std::unique_ptr<ModArchive>> finish(std::unique_ptr<ModArchive> archive, std::uint64_t size,
                                                    const ModLimits& limits);
  Status list(std::uint64_t archive_size, const ModLimits& limits);

  ::zip* archive_;
  FileData data_;
  std::string name_;
  ModPlan plan_;
};

// Why a file cannot have this name on every system that the game runs on: "it leads outside"; empty if it can.
std::string name_fault(std::string_view name);
// A mod's folder by what its archive is called: lower case, letters, digits and "._+-"; empty if none is left.
std::string mod_folder_name(std::string_view called);

}  // namespace fb::fs
