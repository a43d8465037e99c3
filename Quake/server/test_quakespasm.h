// QuakeSpasm itself, as Debian packages it, to compare with: runs a dedicated server on LibreQuake's maps with QuakeC
// of the test's own and gives back what it printed. For tests, which skip where QuakeSpasm, its data or the compiler is
// missing.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "base/bytes.h"

namespace fb::sv::testing {

inline std::filesystem::path game_data() {
  const char* variable = std::getenv("FULLBRIGHT_TEST_DATA");
  return variable != nullptr ? variable : "../shared/librequake";
}

// The program; empty where it is not installed.
inline std::string quakespasm_program() {
  for (const char* path : {"/usr/games/quakespasm", "/usr/bin/quakespasm", "/usr/local/bin/quakespasm"})
    if (std::filesystem::exists(path)) return path;
  return {};
}

// What is missing for run_quakespasm, for GTEST_SKIP; empty if nothing is.
inline std::string quakespasm_lacks() {
  if (quakespasm_program().empty()) return "quakespasm is not installed";
  if (!std::filesystem::exists(game_data() / "id1" / "pak1.pak"))
    return "no LibreQuake data in " + game_data().string();
  return {};
}

// A port that other tests on this machine, at the same time, hardly have.
inline int quakespasm_port() { return 27000 + getpid() % 20000; }

// A dedicated server for four on `map`, as fast as it goes, until QuakeC says `quit` or a minute is over.
inline std::string run_quakespasm(const Bytes& progs, std::string_view map) {
  namespace stdfs = std::filesystem;
  std::string folder = (stdfs::temp_directory_path() / "fullbright_quakespasm_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return {};
  stdfs::create_directories(stdfs::path(folder) / "id1");
  stdfs::create_directories(stdfs::path(folder) / "game");
  for (const auto& entry : stdfs::directory_iterator(stdfs::absolute(game_data()) / "id1"))
    stdfs::create_symlink(entry.path(), stdfs::path(folder) / "id1" / entry.path().filename());
  std::ofstream(folder + "/game/progs.dat", std::ios::binary)
      .write(reinterpret_cast<const char*>(progs.data()), static_cast<std::streamsize>(progs.size()));
  const std::string command = fmt::format(
      "cd '{}' && HOME='{}' timeout 60 '{}' -dedicated 4 -basedir . -game game -port {} +sys_ticrate 0.001 +developer "
      "1 "
      "+map {} >out.txt 2>&1 </dev/null",
      folder, folder, quakespasm_program(), quakespasm_port(), map);
  (void)!std::system(command.c_str());
  std::stringstream out;
  out << std::ifstream(folder + "/out.txt").rdbuf();
  stdfs::remove_all(folder);
  return out.str();
}

}  // namespace fb::sv::testing
