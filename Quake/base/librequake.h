// Where LibreQuake's data may lie, which the project does not contain: tests and benchmarks that want real maps are
// skipped without it, saying so, and the laboratory's suites skip their views of its maps.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace fb {

// The folder that holds its id1: FULLBRIGHT_TEST_DATA, else ../shared/librequake beside the sources.
inline std::filesystem::path librequake_folder() {
  const char* named = std::getenv("FULLBRIGHT_TEST_DATA");
  return named != nullptr ? named : "../shared/librequake";
}

// What is missing and how to have it, for GTEST_SKIP; empty where the file is there.
inline std::string librequake_lacks(std::string_view file = "id1/pak0.pak") {
  std::error_code ignored;
  const std::filesystem::path folder = librequake_folder();
  if (std::filesystem::exists(folder / file, ignored)) return {};
  return "no LibreQuake in " + folder.string() + ": FULLBRIGHT_TEST_DATA names the folder that holds its " +
         std::string(file);
}

}  // namespace fb
