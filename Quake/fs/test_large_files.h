// For tests: sparse files of gigabytes, which take almost no room on disk.
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/bytes.h"
#include "fs/test_paks.h"

namespace fb::fs {

constexpr std::uint32_t kLargeSize = 0x7fffff00u;  // bytes

// False if the file system has no sparse files, or no room.
inline bool put_large(const std::filesystem::path& path, std::string_view beginning, std::uint64_t size = kLargeSize) {
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  std::ofstream(path, std::ios::binary) << beginning;
  std::filesystem::resize_file(path, size, failed);
  return !failed;
}

// A pak whose only entry has kLargeSize bytes and begins with the given text.
inline bool put_large_pak(const std::filesystem::path& path, std::string_view entry, std::string_view beginning) {
  std::string page(beginning);
  page.resize(4096);  // then the directory, which no reader should reach
  Bytes pak = make_pak({{std::string(entry), page}});
  const std::size_t directory = pak.size() - 64;
  for (std::size_t i = 0; i < 4; ++i) pak[directory + 60 + i] = static_cast<std::uint8_t>(kLargeSize >> (8 * i));
  return put_large(path, {reinterpret_cast<const char*>(pak.data()), pak.size()}, 12ull + kLargeSize);
}

}  // namespace fb::fs
