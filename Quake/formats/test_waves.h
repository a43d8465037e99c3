// Small wave files made in code, for tests and for the fuzzer's seeds (test_bytes.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formats/test_bytes.h"

namespace fb::formats::testing {

struct WaveFile {
  std::uint32_t rate = 11025, channels = 1, bits = 16, format = 1;
  std::vector<int> samples = {0, 1000, -1000, 32767, -32768, 5};  // as 16 bits; the file's own width is written
  std::optional<std::uint32_t> cue = std::nullopt, marked = std::nullopt;  // start of the loop, its length
  bool odd_chunk = false;  // one of three bytes and its padding, before the format
};

inline void write_chunk(ByteWriter& w, std::string_view id, ByteView contents) {
  w.text(id, 4);
  w.u32(static_cast<std::uint32_t>(contents.size()));
  w.bytes(contents);
  if (contents.size() % 2 != 0) w.u8(0);
}

inline Bytes write_wav(const WaveFile& wave) {
  ByteWriter body, format, data, cue, label, list;
  format.u16(wave.format);
  format.u16(wave.channels);
  format.u32(wave.rate);
  format.u32(wave.rate * wave.channels * wave.bits / 8);
  format.u16(wave.channels * wave.bits / 8);
  format.u16(wave.bits);
  for (const int sample : wave.samples) {
    const auto value = static_cast<std::uint32_t>(sample);
    if (wave.bits == 8)
      data.u8(static_cast<std::uint32_t>(sample / 256 + 128));
    else
      data.u16(value & 0xffffu);
  }
  if (wave.odd_chunk) write_chunk(body, "odd ", Bytes{1, 2, 3});
  write_chunk(body, "fmt ", format.out);
  write_chunk(body, "data", data.out);
  if (wave.cue) {
    for (const std::uint32_t field : {1u, 1u, *wave.cue, 0u, 0u, 0u, *wave.cue}) cue.u32(field);
    write_chunk(body, "cue ", cue.out);
  }
  if (wave.marked) {
    label.u32(1);
    label.u32(*wave.marked);
    label.text("mark", 4);
    label.text("", 8);
    list.text("adtl", 4);
    write_chunk(list, "ltxt", label.out);
    write_chunk(body, "LIST", list.out);
  }
  ByteWriter file;
  file.text("RIFF", 4);
  file.u32(static_cast<std::uint32_t>(body.out.size() + 4));
  file.text("WAVE", 4);
  file.bytes(body.out);
  return file.out;
}

}  // namespace fb::formats::testing
