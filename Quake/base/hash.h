// 64-bit content hashes (XXH3): the same on every machine of the same byte order.
#pragma once

#include <cstdint>
#include <span>

namespace fb {

std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed = 0);

template <typename T>
std::uint64_t hash_span(std::span<const T> items, std::uint64_t seed = 0) {
  return hash_bytes(items.data(), items.size_bytes(), seed);
}

}  // namespace fb
