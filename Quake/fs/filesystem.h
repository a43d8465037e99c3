// The game's files, wherever they lie. QuakeSpasm's search order, first found wins:
//
//   the last gamedir named, then those before it, id1 last; and of each gamedir
//     user directory: pakN.pak ... pak1.pak, pak0.pak, then loose files
//     base directory: pakN.pak ... pak1.pak, pak0.pak, then loose files
//   and, where none of these has a progs.dat, the base game's id1 (FsOptions::base_game)
//
// Paks are numbered from 0 without a gap: after the first number that is missing no more are opened. (QuakeSpasm's own
// quakespasm.pak and its shareware rule, which hides loose files in subdirectories, are left out.) A name is taken as
// it is; only where nothing has it, one that differs in case is, with one line in the log a file.
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
#include "fs/options.h"
#include "fs/pak.h"

namespace fb::fs {

struct FoundFile {
  std::string name;        // "maps/start.bsp"
  std::string source;      // see FileSystem::source_of
  std::uint64_t size = 0;  // bytes
};

// Reading is const and safe from several threads. Names are normalised (fs/path.h); one that is refused there is
// simply not found.
class FileSystem {
 public:
  // Opens every pak. Fails on a missing id1, a missing gamedir that was asked for, a gamedir or a pak that cannot be
  // read, and a pak that is malformed. Warns of folders in them that cannot be read.
  static Result<FileSystem> open(const FsOptions& options);
  FileSystem(FileSystem&&) noexcept;
  FileSystem& operator=(FileSystem&&) noexcept;
  ~FileSystem();

  // The file's bytes; nullopt where there is none, or, after a logged sentence, where it cannot be read. What keeps
  // files from being found at all is logged once.
  std::optional<FileData> read(std::string_view name) const;
  // The same with the cause.
  Result<FileData> load(std::string_view name) const;
  // Only from the last gamedir's loose files, the user's before the base directory's: what a game has written itself
  // (saves). Nullopt as above.
  std::optional<FileData> read_own(std::string_view name) const;
  bool exists(std::string_view name) const;
  // What keeps a file that is there from being read: its own permissions, a folder's on the way to it, a link to
  // nothing. Nullopt where nothing does, and where there is no such file.
  std::optional<Error> obstacle(std::string_view name) const;
  // Where read() finds it: "id1/pak0.pak", "id1" for a loose file, "user/id1" and "user/id1/pak0.pak" below the user
  // directory, "basegame/id1" in the base game beneath other data; empty where it does not.
  std::string source_of(std::string_view name) const;
  // Which gamedir read() finds it in: 0 for id1, 1 for the next; -1 for the base game beneath them, and for none. By it
  // those who read maps and models decide whether what stands beside one counts.
  int game_index_of(std::string_view name) const;

  // All files whose name starts with `prefix` and ends with `extension` (".bsp"; both in any case), by name, each once,
  // as read() would find it.
  std::vector<FoundFile> find(std::string_view prefix, std::string_view extension) const;

  // Where to write `name`: below the user directory, else below the base directory, in the last gamedir. Fails on a
  // name that is refused. Directories are not made here: see write().
  Result<std::filesystem::path> write_path(std::string_view name) const;
  // Writes there, whole or not at all.
  Status write(std::string_view name, ByteView data) const;

  // What was opened, in search order, for people: "id1/pak1.pak (300 files)".
  std::vector<std::string> describe() const;
  // "id1" or the last gamedir.
  const std::string& game() const;
  const FsOptions& options() const;
  // As a function for those who need no more than that. The FileSystem must outlive it and stay where it is.
  FileLoader loader() const;

 private:
  struct Impl;
  explicit FileSystem(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::fs
