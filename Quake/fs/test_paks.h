// For tests and fuzzers: paks made in code.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.h"

namespace fb::fs {

inline void append_u32(Bytes& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

// Files in order, then the directory.
inline Bytes make_pak(const std::vector<std::pair<std::string, std::string>>& files) {
  Bytes pak = {'P', 'A', 'C', 'K'};
  std::uint32_t data_size = 0;
  for (const auto& [name, text] : files) data_size += static_cast<std::uint32_t>(text.size());
  append_u32(pak, 12 + data_size);
  append_u32(pak, static_cast<std::uint32_t>(64 * files.size()));
  for (const auto& [name, text] : files) pak.insert(pak.end(), text.begin(), text.end());
  std::uint32_t offset = 12;
  for (const auto& [name, text] : files) {
    char field[56] = {};
    std::memcpy(field, name.data(), std::min(name.size(), sizeof(field)));
    pak.insert(pak.end(), field, field + sizeof(field));
    append_u32(pak, offset);
    append_u32(pak, static_cast<std::uint32_t>(text.size()));
    offset += static_cast<std::uint32_t>(text.size());
  }
  return pak;
}

}  // namespace fb::fs
