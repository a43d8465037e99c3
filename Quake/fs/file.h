// Files of the operating system: reading at an offset without a shared position (so that threads need no lock), and
// writing such that a reader, or a crash, sees the old bytes or the new ones and never half of them.
//
// Small files are read whole. Large ones are mapped, so that a parser which refuses a file of gigabytes at its fourth
// byte has cost one page. What is mapped must keep its length while somebody reads it: to look at a page that was cut
// off ends the program (SIGBUS). That is why small files, which people edit while they play, are not mapped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"

namespace fb::fs {

constexpr std::uint64_t kMostReadWhole = 16u << 20u;  // bytes: a hundredth of a second

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
  // A part of the file, mapped where it is larger than kMostReadWhole and the system can. Fails as read_at().
  Result<FileData> read(std::uint64_t offset, std::uint64_t size) const;

 private:
  RandomAccessFile() = default;
  void close();
  Error ends_short(std::uint64_t offset, std::uint64_t by) const;

  std::string name_;
  std::intptr_t handle_ = -1;
  std::uint64_t size_ = 0;
};

// The whole file.
Result<FileData> read_whole_file(const std::filesystem::path& path);
// Writes beside the path under another name, then renames over it. Makes the directories that are missing.
Status write_file_atomically(const std::filesystem::path& path, ByteView data);

}  // namespace fb::fs
