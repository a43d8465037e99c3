// For the tests of this module: a directory that vanishes with the test.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "fs/test_paks.h"

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

inline std::string as_text(const Bytes& data) { return std::string(data.begin(), data.end()); }

}  // namespace fb::fs
