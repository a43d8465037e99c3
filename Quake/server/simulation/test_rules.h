// The rules of testdemos/rules, compiled by fteqcc with more QuakeC behind them. For tests, which run in the top
// folder.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/bytes.h"
#include "base/test_directory.h"
#include "fs/file.h"
#include "progs/test_qc.h"

namespace fb::sv::testing {

// progs.dat; a StartFrame in `more` is instead of the rules' own. Empty where there is no compiler, or it does not
// compile.
inline Bytes compile_rules(const std::string& more) {
  const TestDirectory directory;
  std::filesystem::copy("testdemos/rules", directory.path());
  directory.put("more.qc", more);
  if (more.find("StartFrame") != std::string::npos) {
    const auto main_bytes = fs::read_whole_file(directory.path() / "main.qc");
    std::string main_text = main_bytes ? std::string(main_bytes->begin(), main_bytes->end()) : std::string();
    const std::string theirs = "void() StartFrame = {};";
    if (const auto at = main_text.find(theirs); at != std::string::npos) main_text.erase(at, theirs.size());
    directory.put("main.qc", main_text);
  }
  std::ofstream(directory.path() / "progs.src", std::ios::app) << "\nmore.qc\n";
  const std::string command =
      fmt::format("cd '{}' && fteqcc -O0 -Tstandard -srcfile progs.src >log.txt 2>&1", directory.path().string());
  Bytes progs;
  if (std::system(command.c_str()) == 0)
    if (auto bytes = fs::read_whole_file(directory.path() / "progs.dat")) progs.assign(bytes->begin(), bytes->end());
  return progs;
}

}  // namespace fb::sv::testing
