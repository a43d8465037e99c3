// A file that is whole before it has its name: it grows beside it under a name of its own, which no other program
// chooses, and is renamed at the end, so that readers and crashes see the former file or the new one. What killed
// programs have left is removed when the folder is next written to, at most once a minute.
#pragma once

#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "base/result.h"
#include "fs/file.h"
#include "fs/held_file.h"

namespace fb::fs {

class TemporaryFile {
 public:
  // For a file that will be `target`; makes its folder. A link of this name is replaced, not followed.
  static Result<TemporaryFile> create(const std::filesystem::path& target);
  TemporaryFile(TemporaryFile&& other) noexcept = default;
  TemporaryFile& operator=(TemporaryFile&& other) = delete;
  ~TemporaryFile();  // removes it unless it was committed

  const std::filesystem::path& path() const { return path_; }  // for libraries that write by name
  Status append(ByteView data) const { return file_.append(data); }
  // Gives it its name, and the permissions of the file that it replaces.
  Status commit(Flush flush);

 private:
  TemporaryFile(std::filesystem::path target, HeldFile file)
      : path_(file.path()), target_(std::move(target)), file_(std::move(file)) {}

  std::filesystem::path path_, target_;  // path_ is empty once there is nothing to remove
  HeldFile file_;
};

// A name that no other program chooses. What has it and is held by nobody (fs/held_file.h) is removed as a dead
// program's, a folder with all that is in it.
std::string temporary_name();
// Whether a file's name is such a one.
bool is_temporary_name(const std::string& name);
// Removes what killed programs have left in a folder.
void remove_left_over(const std::filesystem::path& folder);

}  // namespace fb::fs
