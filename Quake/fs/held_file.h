// A file that is being written, held by a lock for as long as it is: programs that share a folder tell by it
// what a living one writes from what a dead one has left, since the system ends a lock with its process. Where a file
// system has no locks, nothing is ever taken for a dead one's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::fs {

class HeldFile {
 public:
  // A new file of a name that `name` gives, each time another one: remove_unless_held removes by name, so no second
  // file may have it. Fails where something has it. Errors call the file `called`.
  static Result<HeldFile> create(const std::function<std::filesystem::path()>& name, const std::string& called);
  // The file of this name as it is, or a new one. A device is taken, too; a link is not followed. Fails if another
  // program holds it.
  static Result<HeldFile> take(const std::filesystem::path& path);
  // The same with a folder, so that what is in it is this program's.
  static Result<HeldFile> take_folder(const std::filesystem::path& path);
  HeldFile(HeldFile&& other) noexcept;
  HeldFile& operator=(HeldFile&& other) noexcept;
  HeldFile(const HeldFile&) = delete;
  HeldFile& operator=(const HeldFile&) = delete;
  ~HeldFile();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const;
  // Behind what is there.
  Status append(ByteView data) const;
  Status write_at(std::uint64_t offset, ByteView data) const;
  // To its first bytes; a device is left as it is.
  Status cut(std::uint64_t size) const;
  // Onto the disk.
  Status flush() const;
  // Its permissions become those of the file that it will replace, if there is one.
  void resemble(const std::filesystem::path& former) const;

 private:
  HeldFile(std::filesystem::path path, std::string called, std::intptr_t handle)
      : path_(std::move(path)), called_(std::move(called)), handle_(handle) {}
  static Result<HeldFile> take(const std::filesystem::path& path, int flags);  // of POSIX's open()
  bool stands_there() const;
  Error failure() const;

  std::filesystem::path path_;
  std::string called_;
  std::intptr_t handle_ = -1;  // a file, or what stands for a folder that is held
};

// Removes a file or a folder unless somebody holds it. What is made later under its name may go with it.
void remove_unless_held(const std::filesystem::path& path);
// What a file holds, or a folder's names, onto the disk. Where that cannot be done, the system chooses the moment.
void flush_path(const std::filesystem::path& path);
// All that was written to its file system, at once.
void flush_file_system(const std::filesystem::path& folder);

}  // namespace fb::fs
