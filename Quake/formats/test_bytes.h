// Writes files number by number, for tests. The writers that use it (test_bsp.h, test_models.h, test_files.h) make
// small valid files and check nothing: a test breaks a structure, writes it, and checks the parser's answer.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "base/bytes.h"
#include "base/maths.h"

namespace fb::formats::testing {

// Little-endian bytes, appended.
class ByteWriter {
 public:
  Bytes out;

  void u8(std::uint32_t v) { out.push_back(static_cast<std::uint8_t>(v)); }
  void u16(std::uint32_t v) {
    u8(v & 0xffu);
    u8(v >> 8u & 0xffu);
  }
  void u32(std::uint32_t v) {
    u16(v & 0xffffu);
    u16(v >> 16u);
  }
  void i32(std::int32_t v) { u32(static_cast<std::uint32_t>(v)); }
  void f32(float v) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    u32(bits);
  }
  void vec(const vec3& v) {
    for (int axis = 0; axis < 3; ++axis) f32(v[axis]);
  }
  // A field of n bytes, padded with zeros.
  void text(std::string_view s, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) u8(i < s.size() ? static_cast<std::uint8_t>(s[i]) : 0u);
  }
  void bytes(ByteView data) { out.insert(out.end(), data.begin(), data.end()); }
  void patch_u32(std::size_t at, std::uint32_t v) {
    for (std::size_t i = 0; i < 4; ++i) out[at + i] = static_cast<std::uint8_t>(v >> (8 * i));
  }
};

}  // namespace fb::formats::testing
