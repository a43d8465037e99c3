// For the tests of this module: a directory that vanishes with the test, and paks made in code.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bytes.h"

namespace fb::fs {

class TestDirectory {
 public:
  TestDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "fullbright-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) ADD_FAILURE() << "no temporary directory";
    path_ = pattern;
  }
  ~TestDirectory() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  TestDirectory(const TestDirectory&) = delete;
  TestDirectory& operator=(const TestDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void put(const std::string& name, std::string_view text) const {
    const auto path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  void put(const std::string& name, const Bytes& data) const {
    put(name, std::string_view(reinterpret_cast<const char*>(data.data()), data.size()));
  }

 private:
  std::filesystem::path path_;
};

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

inline std::string as_text(const Bytes& data) { return std::string(data.begin(), data.end()); }

}  // namespace fb::fs
