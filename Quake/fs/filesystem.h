// The game's files in paks and folders. QuakeSpasm's search order; the first match is used:
//
//   the gamedir named last, then those before it, id1 last; and for each gamedir
//     user directory: *.pk3, the last by name first, then pakN.pak ... pak1.pak, pak0.pak, then loose files
//     base directory: the same
//   and, if none of these has a progs.dat, the base game's id1 (FsOptions::base_game)
//
// Paks are numbered from 0 without a gap: none after the first missing number is opened. Archives (fs/zip.h) have any
// name that ends with .pk3; one that cannot be read is left out, with a warning. (QuakeSpasm's own quakespasm.pak and
// its shareware rule, which hides loose files in subdirectories, do not exist here.) Names are matched exactly; only if
// nothing matches, ignoring case, with one line in the log for each file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "fs/file.h"
#include "fs/options.h"
#include "fs/pak.h"

namespace fb::fs {

struct FoundFile {
  std::string name;        // "maps/start.bsp"
  std::string source;      // see FileSystem::source_of
  std::uint64_t size = 0;  // bytes
};

// Reading is const and safe from several threads. Names are normalised (fs/path.h); a name refused there is not found.
class FileSystem {
 public:
  // Opens every pak. Fails on a missing id1, on a gamedir that was named and does not exist, on a gamedir or a pak that
  // cannot be read, and on a malformed pak. Warns of folders in them that cannot be read.
  static Result<FileSystem> open(const FsOptions& options);
  FileSystem(FileSystem&&) noexcept;
  FileSystem& operator=(FileSystem&&) noexcept;
  ~FileSystem();

  // The file's bytes; nullopt if there is none, or, after a logged message, if it cannot be read. A cause that keeps
  // files from being found at all is logged once.
  std::optional<FileData> read(std::string_view name) const;
  // The same, with the cause of a failure.
  Result<FileData> load(std::string_view name) const;
  // Bytes of the file from `offset` on, at most `most`, without reading the rest: headers of many files.
  Result<FileData> load_part(std::string_view name, std::uint64_t offset, std::uint64_t most) const;
  // As read(), for QuakeC: what is only there by a link that leads out of the searched folders is not read, and logged
  // once.
  std::optional<FileData> read_for_mod(std::string_view name) const;
  // Searches only the last gamedir's loose files, the user's before the base directory's: files that the game has
  // written itself (saves). Nullopt as above.
  std::optional<FileData> read_own(std::string_view name) const;
  // All files of exactly this name, in search order, for data that files of one name add up to. What cannot be read is
  // warned of.
  std::vector<FileData> read_all(std::string_view name) const;
  bool exists(std::string_view name) const;
  // The reason why an existing file cannot be read: its own permissions, those of a folder on its path, or a broken
  // link. Nullopt if it can be read, or does not exist.
  std::optional<Error> obstacle(std::string_view name) const;
  // The place where read() finds it: "id1/pak0.pak", "id1" for a loose file, "user/id1" and "user/id1/pak0.pak" below
  // the user directory, "basegame/id1" in a base game below other data; empty if it does not.
  std::string source_of(std::string_view name) const;
  // The gamedir in which read() finds it: 0 for id1, 1 for the next; -1 for a base game below them, and if not found.
  // Loaders of maps and models compare it, to decide whether files that belong to a map or model apply.
  int game_index_of(std::string_view name) const;
  // Whether read() finds it in the base game, wherever that is: below other data, or in their place.
  bool is_of_base_game(std::string_view name) const;

  // All files whose name starts with `prefix` and ends with `extension` (".bsp"; both in any case), by name, each once,
  // as read() would find it.
  std::vector<FoundFile> find(std::string_view prefix, std::string_view extension) const;

  // Where to write `name`: below the user directory, else below the base directory, in the last gamedir. Fails on a
  // name that is refused, where there is no home to write to, and where a link within the gamedir leads out of it; one
  // that stays in it is followed, and so is config.cfg, to another file of settings (.cfg), where people keep theirs.
  // The user directory and the gamedir may themselves be links. Directories are not made here: see write().
  Result<std::filesystem::path> write_path(std::string_view name) const;
  // Writes the file there completely, or not at all.
  Status write(std::string_view name, ByteView data, Flush flush = Flush::kNow) const;

  // The opened places in search order, for people: "id1/pak1.pak (300 files)".
  std::vector<std::string> describe() const;
  // "id1" or the last gamedir.
  const std::string& game() const;
  const FsOptions& options() const;
  // Where the gamedirs are: the user directory, if there is one, and the base directory.
  std::vector<std::filesystem::path> folders() const;
  // As a function, for code that only needs to read. The FileSystem must outlive it and must not move.
  FileLoader loader() const;

 private:
  struct Impl;
  explicit FileSystem(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::fs
