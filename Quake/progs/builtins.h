// The table of builtins: what QuakeC's functions without a body do. One table belongs to one virtual machine; some
// builtins (files, tokenize) keep their state in it.
//
//   BuiltinTable table = standard_builtins(services);       // everything that needs no server
//   table.set(2, "setorigin", [&server](Vm& vm) { ... });   // the server's own
//   table.add_extension("FTE_SV_POINTPARTICLES");           // what checkextension answers for
//   auto vm = Vm::create(program, std::move(table), options);
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "base/rng.h"

namespace fb::con {
class Console;
}

namespace fb::progs {

class Vm;

// Reads its parameters with vm.parm_*(i), answers with vm.return_*(...), and fails with vm.fail(sentence): QuakeC ends
// as the builtin returns. Reading a parameter that makes no sense fails the same way and gives zero, "" or the world.
using Builtin = std::function<void(Vm&)>;

class BuiltinTable {
 public:
  static constexpr std::uint32_t kMaxNumber = 4095;

  // Replaces what has that number. The name is what #0:name and error messages call it.
  void set(std::uint32_t number, std::string_view name, Builtin builtin);
  // nullptr where there is none: calling it is an error of QuakeC.
  const Builtin* find(std::uint32_t number) const;
  // 0 where there is none.
  std::uint32_t number_of(std::string_view name) const;
  std::string_view name_of(std::uint32_t number) const;

  void add_extension(std::string_view name) { extensions_.emplace(name); }
  bool has_extension(std::string_view name) const { return extensions_.contains(name); }

 private:
  struct Entry {
    std::string name;
    Builtin builtin;
  };
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::set<std::string, std::less<>> extensions_;
};

// What builtins need of the engine. Everything may be left out: without a console cvars are 0 and commands go nowhere,
// without files none is found, without `rng` random() begins at the same number each time.
struct Services {
  con::Console* console = nullptr;
  // FRIK_FILE: names as fs/path.h has them, all below data/ but for reading. Usually FileSystem::read and ::write.
  FileLoader read_file;
  std::function<Status(std::string_view name, ByteView data)> write_file;
  Rng* rng = nullptr;  // the engine's, seeded by -seed
  // Where text without an end of line goes: to the console (errors, eprint), to developers (dprint), to all players
  // (bprint). Without the first the log has it; without the second, `print` has it while cvar developer is on; without
  // the third, `print` has it.
  std::function<void(std::string_view)> print, developer_print, broadcast;
};

// Numbers and names as Quake's defs.qc, dpextensions.qc and fteextensions.qc have them. All objects of `services` must
// outlive the table.
BuiltinTable standard_builtins(const Services& services);

}  // namespace fb::progs
