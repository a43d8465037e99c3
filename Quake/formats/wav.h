// Wave files as Quake plays them: RIFF/WAVE, PCM of 8 or 16 bits, and the loop that its chunks describe. A `cue `
// chunk's first point is the sample at which the loop begins. An `ltxt` of purpose "mark", in a `LIST` of kind "adtl"
// behind the cue, holds the loop's length in samples; without one the loop ends with the data. Samples that the file
// says it has and does not hold are left out, and other chunks beyond its end. After parsing there is at least one
// sample, the rate is within kLowestRate and kHighestRate, and the loop begins before the last sample.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"

namespace fb::formats {

constexpr std::uint32_t kLowestRate = 1000, kHighestRate = 384000;  // Hz

struct Wav {
  std::uint32_t rate = 0;             // samples a second
  int bits = 16;                      // of the file: 8 or 16
  int channels = 1;                   // of the file; two are averaged
  std::vector<std::int16_t> samples;  // one channel; 8 bits become the upper ones
  std::optional<std::uint32_t> loop_start;
  std::string flaw;  // a sentence about what cannot be as the file says, and is played otherwise; empty: none
};

// Refuses a bad file with file, offset and cause. Memory is bounded by a small multiple of data.size().
Result<Wav> parse_wav(ByteView data, std::string_view name);

}  // namespace fb::formats
