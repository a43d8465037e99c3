// A temporary directory with a unique name, removed when the object is destroyed. For tests and benchmarks.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "base/bytes.h"

namespace fb {

class TestDirectory {
 public:
  TestDirectory() {
    std::random_device dice;
    do path_ = std::filesystem::temp_directory_path() / fmt::format("fullbright-{:08x}{:08x}", dice(), dice());
    while (!std::filesystem::create_directory(path_));
  }
  ~TestDirectory() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  TestDirectory(const TestDirectory&) = delete;
  TestDirectory& operator=(const TestDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
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

}  // namespace fb
