// A sound effect as the mixer plays it: one channel at the mixing rate. Samples never change once made, and are shared
// by the game's thread and the device's. Only the game's thread frees them: see SampleCache.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file_data.h"
#include "base/result.h"
#include "formats/wav.h"

namespace fb::audio {

struct Sample {
  std::string name;                  // "weapons/rocket1i.wav"
  std::vector<std::int16_t> frames;  // at least one
  std::optional<std::size_t> loop_start;
  // Of the file.
  int bits = 16;
  std::uint32_t rate = 0;  // Hz
};
using SamplePtr = std::shared_ptr<const Sample>;

struct SampleFormat {
  std::uint32_t rate = 44100;  // of the mix, Hz
  int quality = 1;             // Resampler's
  bool held = false;           // samples are held instead of filtered (sndspeed)
  bool eight_bits = false;     // loadas8bit
  bool operator==(const SampleFormat&) const = default;
};

// Fails for a sound too long to be kept (25 minutes at 44.1 kHz).
Result<SamplePtr> make_sample(const formats::Wav& wav, const std::string& name, const SampleFormat& format);

// Loads sounds by name, each once. A sample that is dropped here lives until the mixer has let it go; collect() then
// frees it. No other function frees one, so the mixer's thread never does.
class SampleCache {
 public:
  // All that is loaded takes `most_bytes` together at most: far more than a level has, far less than files of a
  // thousandth of its size can ask for (8 bits at 1 kHz become 16 at the mix's rate).
  static constexpr std::uint64_t kMostBytes = std::uint64_t{512} << 20;
  explicit SampleCache(FileLoader files, std::uint64_t most_bytes = kMostBytes)
      : files_(std::move(files)), most_bytes_(most_bytes) {}

  // Null after one logged sentence if the sound is missing or malformed, or if there is no room, which is said once
  // until something is dropped.
  SamplePtr load(std::string_view name);
  // A change drops all samples: what plays keeps its own, the next load() makes new ones.
  void set_format(const SampleFormat& format);
  const SampleFormat& format() const { return format_; }
  // Drops what is not among these.
  void keep_only(const std::vector<std::string>& names);
  // Frees what was dropped and plays no more.
  void collect();
  // What is loaded, by name; null: could not be.
  const std::map<std::string, SamplePtr, std::less<>>& loaded() const { return samples_; }
  std::size_t waiting() const { return dropped_.size(); }

 private:
  Result<SamplePtr> load_file(std::string_view name) const;

  FileLoader files_;
  std::uint64_t most_bytes_, bytes_ = 0;
  bool said_full_ = false;
  std::set<std::string, std::less<>> without_room_;
  SampleFormat format_;
  std::map<std::string, SamplePtr, std::less<>> samples_;
  std::vector<SamplePtr> dropped_;
};

}  // namespace fb::audio
