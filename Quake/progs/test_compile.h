// Compiles QuakeC with Debian's fteqcc. For tests and benchmarks.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "base/bytes.h"
#include "base/test_directory.h"
#include "fs/file.h"
#include "progs/system_defs.h"

namespace fb::progs::testing {

// Quake's own globals and fields, in QuakeC, from the engine's table of them.
inline std::string system_source() {
  const auto qc_type = [](Type type) {
    return type == Type::kFunction ? std::string("void()") : std::string(type_name(type));
  };
  std::string text;
  for (const auto& row : system_globals()) text += fmt::format("{} {};\n", qc_type(row.type), row.name);
  text += "void end_sys_globals;\n";
  for (const auto& row : system_fields()) text += fmt::format(".{} {};\n", qc_type(row.type), row.name);
  text += "void end_sys_fields;\n";
  return text;
}

// The test's own builtins: each adds to the output, with a space between.
constexpr const char* kPutSource = R"(
void(float x) put = #1000;
void(string s) puts = #1001;
void(vector v) putv = #1002;
void(entity e) pute = #1003;
void(string s) putnull = #1004;
)";

struct Compiled {
  bool has_compiler = true;
  std::string output;  // the compiler's
  Bytes progs;         // empty where it failed
};

inline Compiled compile(const std::string& source, const std::string& options = "-O0") {
  static std::map<std::string, Compiled> done;  // several tests share a source
  const std::string key = options + "\n" + source;
  if (const auto found = done.find(key); found != done.end()) return found->second;
  Compiled compiled;
  if (std::system("command -v fteqcc >/dev/null 2>&1") != 0) {
    compiled.has_compiler = false;
    return compiled;
  }
  const TestDirectory directory;
  directory.put("defs.qc", system_source() + kPutSource);
  directory.put("test.qc", source);
  directory.put("progs.src", "progs.dat\ndefs.qc\ntest.qc\n");
  const std::string command = fmt::format("cd '{}' && fteqcc {} -Tstandard -srcfile progs.src >log.txt 2>&1",
                                          directory.path().string(), options);
  if (std::system(command.c_str()) == 0) {
    if (auto bytes = fs::read_whole_file(directory.path() / "progs.dat"))
      compiled.progs.assign(bytes->begin(), bytes->end());
  }
  std::stringstream log;
  log << std::ifstream(directory.path() / "log.txt").rdbuf();
  compiled.output = log.str();
  return done[key] = compiled;
}

}  // namespace fb::progs::testing
