// A sound effect as the mixer plays it: one channel at the mixing rate. Samples never change once made, and are shared
// by the game's thread and the device's. Only the game's thread frees them: see SampleCache.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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
  explicit SampleCache(FileLoader files) : files_(std::move(files)) {}

  // Null after one logged sentence if the sound is missing or malformed.
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
  SampleFormat format_;
  std::map<std::string, SamplePtr, std::less<>> samples_;
  std::vector<SamplePtr> dropped_;
};

}  // namespace fb::audio
