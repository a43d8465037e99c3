// Reads little-endian values from untrusted bytes. A read past the end returns zero and marks the reader as failed, so
// that a parser may read a whole record and check once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/result.h"

namespace fb {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

class ByteReader {
 public:
  // `name` is the source's name in error messages, e.g. "id1/pak0.pak:maps/start.bsp".
  ByteReader(ByteView data, std::string_view name) : data_(data), name_(name) {}

  std::uint8_t u8() { return read<std::uint8_t>(); }
  std::int8_t i8() { return read<std::int8_t>(); }
  std::uint16_t u16() { return read<std::uint16_t>(); }
  std::int16_t i16() { return read<std::int16_t>(); }
  std::uint32_t u32() { return read<std::uint32_t>(); }
  std::int32_t i32() { return read<std::int32_t>(); }
  float f32() { return read<float>(); }
  // The next n bytes; empty, and failed(), if there are fewer.
  ByteView bytes(std::size_t n) {
    if (n > remaining()) {
      fail();
      return {};
    }
    ByteView view = data_.subspan(offset_, n);
    offset_ += n;
    return view;
  }
  // A fixed field of n bytes that ends at its first zero.
  std::string fixed_string(std::size_t n) {
    ByteView view = bytes(n);
    std::size_t length = 0;
    while (length < view.size() && view[length] != 0) ++length;
    return std::string(reinterpret_cast<const char*>(view.data()), length);
  }
  void skip(std::size_t n) { (void)bytes(n); }
  // Seeking past the end fails.
  void seek(std::size_t offset) {
    if (offset > data_.size())
      fail();
    else
      offset_ = offset;
  }

  std::size_t offset() const { return offset_; }
  std::size_t size() const { return data_.size(); }
  std::size_t remaining() const { return data_.size() - offset_; }
  bool failed() const { return failed_; }
  const std::string& name() const { return name_; }
  ByteView data() const { return data_; }

  // "<name>: offset <offset>: <cause>"
  Error error(std::string_view cause) const { return error_at(offset_, cause); }
  Error error_at(std::size_t offset, std::string_view cause) const {
    return Error{name_ + ": offset " + std::to_string(offset) + ": " + std::string(cause)};
  }

 private:
  template <typename T>
  T read() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    if (remaining() < sizeof(T)) {
      fail();
      return value;
    }
    std::memcpy(&value, data_.data() + offset_, sizeof(T));
    offset_ += sizeof(T);
    return value;
  }
  void fail() {
    failed_ = true;
    offset_ = data_.size();
  }

  ByteView data_;
  std::string name_;
  std::size_t offset_ = 0;
  bool failed_ = false;
};

}  // namespace fb
