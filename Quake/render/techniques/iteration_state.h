// Numbers and arrays of them as bytes, as this program has them in memory, and back: how iterations are kept in a file.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "base/bytes.h"

namespace fb::render {

template <typename T>
void put_value(Bytes& state, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
  state.insert(state.end(), from, from + sizeof(T));
}
template <typename T>
void put_array(Bytes& state, const std::vector<T>& items) {
  static_assert(std::is_trivially_copyable_v<T>);
  put_value(state, std::uint64_t{items.size()});
  const auto* from = reinterpret_cast<const std::uint8_t*>(items.data());
  state.insert(state.end(), from, from + items.size() * sizeof(T));
}

// False: the bytes end before. What was read is left as it is.
template <typename T>
bool take_value(ByteReader& state, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const ByteView from = state.bytes(sizeof(T));
  if (from.size() != sizeof(T)) return false;
  std::memcpy(&value, from.data(), sizeof(T));
  return true;
}
template <typename T>
bool take_array(ByteReader& state, std::vector<T>& items) {
  std::uint64_t count = 0;
  if (!take_value(state, count) || count > state.remaining() / sizeof(T)) return false;
  items.resize(count);
  const ByteView from = state.bytes(count * sizeof(T));
  if (count > 0) std::memcpy(items.data(), from.data(), from.size());
  return true;
}

}  // namespace fb::render
