// Files of the operating system: reading at an offset without a shared position (so that threads need no lock), and
// writing such that a reader, or a crash, sees the old bytes or the new ones and never half of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::fs {

// An open file, read only. Reading is safe from several threads at once.
class RandomAccessFile {
 public:
  static Result<RandomAccessFile> open(const std::filesystem::path& path);
  RandomAccessFile(RandomAccessFile&& other) noexcept;
  RandomAccessFile& operator=(RandomAccessFile&& other) noexcept;
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;
  ~RandomAccessFile();

  std::uint64_t size() const { return size_; }  // bytes, when it was opened
  // Fills `into` from `offset` on; fails where the file has fewer bytes by now or the device does.
  Status read_at(std::uint64_t offset, std::span<std::uint8_t> into) const;

 private:
  RandomAccessFile() = default;
  void close();

  std::string name_;
  std::intptr_t handle_ = -1;
  std::uint64_t size_ = 0;
};

// The whole file.
Result<Bytes> read_whole_file(const std::filesystem::path& path);
// Writes beside the path under another name, then renames over it. Makes the directories that are missing.
Status write_file_atomically(const std::filesystem::path& path, ByteView data);

}  // namespace fb::fs
