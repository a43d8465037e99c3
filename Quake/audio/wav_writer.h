// Writes frames into a wave file of 16 bits and two channels, as they come. It grows as NAME.part, whose header counts
// what is there, and gets its name when it is finished: a program that is killed leaves the former file.
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
  // Fails if the file cannot be created, or another program writes it. A device has no other name while it is written,
  // nor has a file that is called .part: whoever wants that gives it its name.
  static Result<WavWriter> create(const std::filesystem::path& path, std::uint32_t rate);
  WavWriter(WavWriter&&) noexcept = default;
  WavWriter& operator=(WavWriter&&) noexcept = default;

  // Interleaved left and right, from -1 to 1. Fails if the disk is full, or at the 4 GiB that such a file can hold; the
  // recording then ends with what was written before.
  Status write(std::span<const float> stereo);
  // To be called once, last. The file gets its name, unless writing has failed and there is one of that name: then it
  // stays NAME.part, and a line says so.
  Status finish();
  const std::string& path() const { return path_; }

 private:
  WavWriter(fs::HeldFile file, std::filesystem::path target, std::string path, std::uint32_t rate)
      : file_(std::move(file)), target_(std::move(target)), path_(std::move(path)), rate_(rate) {}
  Status put_header() const;

  fs::HeldFile file_;
  std::filesystem::path target_;  // that the file is called in the end
  std::string path_;
  std::uint32_t rate_ = 0;
  std::uint64_t bytes_ = 0;  // of frames
  bool failed_ = false;
};

}  // namespace fb::audio
