// Reads and writes the primitive values of network messages. The protocol's flags set the width of coordinates and
// angles; everything is little-endian. A read past the end returns zero and marks the reader as failed, and so does a
// float that is not finite, so that a parser checks once per message.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/maths.h"
#include "net/protocol.h"

namespace fb::net {

class MessageReader {
 public:
  // `name` is the message's name in errors, e.g. "demo1.dem: message at 1234"; the bytes must outlive the reader.
  MessageReader(ByteView data, std::string_view name, Protocol protocol = {})
      : bytes_(data, name), protocol(protocol) {}

  int u8() { return bytes_.u8(); }
  int i8() { return bytes_.i8(); }
  int u16() { return bytes_.u16(); }
  int i16() { return bytes_.i16(); }
  std::int32_t i32() { return bytes_.i32(); }
  float f32();
  float coord();    // units
  float angle();    // degrees
  float angle16();  // degrees; used by clc_move from protocol 666 on
  vec3 coords();
  vec3 angles();
  // Reads up to the terminating zero; fails if there is none.
  std::string string();

  bool at_end() const { return bytes_.remaining() == 0; }
  bool failed() const { return bytes_.failed() || not_finite_; }
  bool not_finite() const { return not_finite_; }
  std::size_t offset() const { return bytes_.offset(); }
  Error error_at(std::size_t offset, std::string_view cause) const { return bytes_.error_at(offset, cause); }

 private:
  ByteReader bytes_;
  bool not_finite_ = false;

 public:
  Protocol protocol;  // svc_serverinfo changes it in the middle of a message
};

class MessageWriter {
 public:
  explicit MessageWriter(Protocol protocol = {}) : protocol(protocol) {}

  // Integers are truncated to their width, as by C casts.
  void u8(int v) { put(static_cast<std::uint8_t>(v)); }
  void i8(int v) { put(static_cast<std::int8_t>(v)); }
  void u16(int v) { put(static_cast<std::uint16_t>(v)); }
  void i16(int v) { put(static_cast<std::int16_t>(v)); }
  void i32(std::int32_t v) { put(v); }
  void f32(float v) { put(v); }
  // Rounded to the nearest value of the protocol, and clamped to its range.
  void coord(float v);
  void angle(float v);
  void angle16(float v);
  void coords(const vec3& v);
  void angles(const vec3& v);
  // An embedded zero ends it.
  void string(std::string_view text);

  void append(ByteView bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

  void truncate(std::size_t size) { bytes_.resize(size < bytes_.size() ? size : bytes_.size()); }

  std::size_t size() const { return bytes_.size(); }
  const Bytes& bytes() const { return bytes_; }
  Bytes take() { return std::move(bytes_); }

 private:
  template <typename T>
  void put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  Bytes bytes_;

 public:
  Protocol protocol;
};

}  // namespace fb::net
