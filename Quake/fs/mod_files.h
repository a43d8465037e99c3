// The files that QuakeC reads and writes (FRIK_FILE). They stay within the game's folders, whatever links a mod's
// archive brought, and within limits of number and size that hold over restarts. Each is written whole, and all of a
// level are put on the disk together: at once, a thousand files take as many waits for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "fs/filesystem.h"

namespace fb::fs {

// Of all that the player's folder of the game has below data/.
struct ModFileLimits {
  std::size_t files = 4096;
  std::uint64_t bytes = 256u << 20u;
  std::size_t depth = 8;  // folders that a file lies in
};

class ModFiles {
 public:
  // `files` must outlive it and must not move.
  explicit ModFiles(const FileSystem& files, const ModFileLimits& limits = {}) : files_(files), limits_(limits) {}

  std::optional<FileData> read(std::string_view name) const { return files_.read_for_mod(name); }
  // `name` begins with data/. Fails beyond the limits.
  Status write(std::string_view name, ByteView data);
  // Puts what was written since the last call on the disk.
  void flush();

 private:
  void count();

  const FileSystem& files_;
  ModFileLimits limits_;
  bool counted_ = false;
  std::size_t number_ = 0;
  std::uint64_t bytes_ = 0;
  std::vector<std::filesystem::path> unflushed_;  // kFewFiles and one more at most
};

}  // namespace fb::fs
