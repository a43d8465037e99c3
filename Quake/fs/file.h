// Files of the operating system: reads at an offset without a shared position (so that threads need no lock), and
// writes such that a reader, or a crash, sees either the old bytes or the new ones, never a mixture.
//
// Small files are read whole. Large ones are memory-mapped, so that a parser which refuses a file of gigabytes at its
// fourth byte has cost one page. A mapped file must keep its length while it is in use: reading a page that was
// truncated ends the program (SIGBUS). This is why small files, which people edit while they play, are not mapped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"

namespace fb::fs {

constexpr std::uint64_t kMostReadWhole = 16u << 20u;  // bytes; reading them takes a hundredth of a second

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
  // Fills `into` from `offset` on. Fails if the file is too short by now, or on a device error.
  Status read_at(std::uint64_t offset, std::span<std::uint8_t> into) const;
  // A part of the file, mapped if it is larger than kMostReadWhole and the system can map it. Fails like read_at().
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

enum class Flush {
  kNow,   // on the disk before it has its name: it survives a power cut from then on
  kLater  // when the system likes: for what can be made again, and for many files that are flushed together
};
// Writes a TemporaryFile (fs/temporary_file.h). Creates missing directories. A link of this name is replaced.
Status write_file_atomically(const std::filesystem::path& path, ByteView data, Flush flush = Flush::kNow);
Status write_text_atomically(const std::filesystem::path& path, std::string_view text);

// For a path that the user has typed: where a link of this name leads, for the file there is the one that is meant.
// Fails on a link that leads in a circle.
Result<std::filesystem::path> output_path(const std::filesystem::path& typed);
// The same as write_text_atomically to there; a device or a pipe (/dev/stdout) is written to, not replaced.
Status write_output(const std::filesystem::path& typed, std::string_view text);

}  // namespace fb::fs
