// For tests: samples and files of sounds made in code.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "audio/sample.h"
#include "formats/test_waves.h"

namespace fb::audio::test {

// A sample of these frames, as if loaded.
inline SamplePtr sample_of(std::vector<std::int16_t> frames, std::optional<std::size_t> loop = std::nullopt,
                           int bits = 16) {
  auto sample = std::make_shared<Sample>();
  sample->name = "test";
  sample->frames = std::move(frames);
  sample->loop_start = loop;
  sample->bits = bits;
  sample->rate = 44100;
  return sample;
}
// `count` frames of the same value: half of full scale by default, so that gains can be read from the mix.
inline SamplePtr constant(std::size_t count, bool loops = false, int bits = 16, std::int16_t value = 16384) {
  return sample_of(std::vector<std::int16_t>(count, value), loops ? std::optional<std::size_t>(0) : std::nullopt, bits);
}

inline std::vector<float> sine(double frequency, double rate, std::size_t count) {
  std::vector<float> samples(count);
  for (std::size_t i = 0; i < count; ++i)
    samples[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / rate));
  return samples;
}
inline double rms(const std::vector<float>& values, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += static_cast<double>(values[i]) * values[i];
  return std::sqrt(sum / static_cast<double>(to - from));
}

// Files by name.
struct Files {
  std::map<std::string, Bytes, std::less<>> files;

  void add_sound(const std::string& name, const formats::testing::WaveFile& wave) {
    files["sound/" + name] = formats::testing::write_wav(wave);
  }
  FileLoader loader() const {
    return [this](std::string_view name) -> std::optional<FileData> {
      const auto found = files.find(name);
      if (found == files.end()) return std::nullopt;
      return FileData(found->second);
    };
  }
};

}  // namespace fb::audio::test
