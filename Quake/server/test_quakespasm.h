// QuakeSpasm itself, as Debian packages it, to compare with: runs a dedicated server on LibreQuake's maps with QuakeC
// of the test's own and gives back what it printed. For tests, which skip where QuakeSpasm, its data or the compiler is
// missing.
#pragma once

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/bytes.h"
#include "base/test_directory.h"
#include "server/test_librequake.h"

namespace fb::sv::testing {

// A mod in which nobody plays and nothing of a map is alive; it lacks worldspawn.
constexpr const char* kIdleMod = R"(
void() main = {};
void() barrel_explode = {};
void() PlayerPreThink = {};
void() PlayerPostThink = {};
void() ClientKill = {};
void() ClientConnect = {};
void() PutClientInServer = {};
void() ClientDisconnect = {};
void() SetNewParms = {};
void() SetChangeParms = {};
)";

// Numbers by arithmetic that is exact in floats, from `seed` on; and numbers said whole, in three integers.
constexpr const char* kExactNumbers = R"(
float seed;
float(float low) random_from = {
  seed = seed * 109 + 1021;
  seed = seed - floor(seed / 65536) * 65536;
  return low + seed / 16;
};
void(float f) say = {
  local float whole, rest, part;
  whole = floor(f);
  rest = (f - whole) * 4096;
  part = floor(rest);
  dprint(" "); dprint(ftos(whole));
  dprint(" "); dprint(ftos(part));
  dprint(" "); dprint(ftos(floor((rest - part) * 65536)));
};
void(vector v) say3 = { say(v_x); say(v_y); say(v_z); };
)";

// The program; empty where it is not installed.
inline std::string quakespasm_program() {
  for (const char* path : {"/usr/games/quakespasm", "/usr/bin/quakespasm", "/usr/local/bin/quakespasm"})
    if (std::filesystem::exists(path)) return path;
  return {};
}

// What is missing for run_quakespasm, for GTEST_SKIP; empty if nothing is.
inline std::string quakespasm_lacks() {
  if (quakespasm_program().empty()) return "quakespasm is not installed";
  return game_data_lacks();
}

// A port that other tests on this machine, at the same time, hardly have.
inline int quakespasm_port() { return 27000 + getpid() % 20000; }

// A dedicated server for four on `map`, as fast as it goes, until QuakeC says `quit`, a minute is over or this is gone.
class QuakeSpasmServer {
 public:
  // `commands` are executed before the map: "+sv_protocol 15".
  QuakeSpasmServer(const Bytes& progs, const std::string& map, const std::string& commands = "",
                   int port = quakespasm_port())
      : port_(port) {
    namespace stdfs = std::filesystem;
    stdfs::create_directories(folder_ / "id1");
    for (const auto& entry : stdfs::directory_iterator(stdfs::absolute(librequake_folder()) / "id1"))
      stdfs::create_symlink(entry.path(), folder_ / "id1" / entry.path().filename());
    directory_.put("game/progs.dat", progs);
    const std::string command = fmt::format(
        "cd '{0}' && HOME='{0}' exec timeout 60 '{1}' -dedicated 4 -basedir . -game game -port {2} "
        "+sys_ticrate 0.001 +developer 1 {4} +map {3} >out.txt 2>&1 </dev/null",
        folder_.string(), quakespasm_program(), port, map, commands);
    process_ = fork();
    if (process_ == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  ~QuakeSpasmServer() {
    if (process_ > 0) {
      kill(process_, SIGTERM);  // timeout hands it on
      wait();
    }
  }
  QuakeSpasmServer(const QuakeSpasmServer&) = delete;
  QuakeSpasmServer& operator=(const QuakeSpasmServer&) = delete;

  int port() const { return port_; }
  void wait() {
    if (process_ > 0) waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  // What it has printed so far.
  std::string output() const {
    std::stringstream out;
    out << std::ifstream(folder_ / "out.txt").rdbuf();
    return out.str();
  }

 private:
  const TestDirectory directory_;
  const std::filesystem::path folder_ = directory_.path();
  int port_;
  pid_t process_ = -1;
};

inline std::string run_quakespasm(const Bytes& progs, const std::string& map) {
  QuakeSpasmServer server(progs, map);
  server.wait();
  return server.output();
}

}  // namespace fb::sv::testing
