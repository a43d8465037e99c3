// Writes frames into a wave file of 16 bits and two channels, as they come.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "base/result.h"
#include "fs/held_file.h"

namespace fb::audio {

class WavWriter {
 public:
  // Fails if the file cannot be created, or another program writes it.
  static Result<WavWriter> create(const std::filesystem::path& path, std::uint32_t rate);
  WavWriter(WavWriter&&) noexcept = default;
  WavWriter& operator=(WavWriter&&) noexcept = default;

  // Interleaved left and right, from -1 to 1. Fails if the disk is full, or at the 4 GiB that such a file can hold.
  Status write(std::span<const float> stereo);
  // Completes the header; without it the file counts as empty. To be called once, last.
  Status finish();
  const std::string& path() const { return path_; }

 private:
  WavWriter(fs::HeldFile file, std::string path, std::uint32_t rate)
      : file_(std::move(file)), path_(std::move(path)), rate_(rate) {}
  Status put_header(std::uint32_t bytes);

  fs::HeldFile file_;
  std::string path_;
  std::uint32_t rate_ = 0;
  std::uint64_t bytes_ = 0;  // of frames
};

}  // namespace fb::audio
