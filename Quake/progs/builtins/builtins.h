// The builtins that need no server: mathematics, strings, fields of entities, files, the console.
#pragma once

#include <functional>
#include <string_view>

#include "base/bytes.h"
#include "base/file_data.h"
#include "base/result.h"
#include "base/rng.h"
#include "progs/builtin_table.h"

namespace fb::con {
class Console;
}

namespace fb::progs {

// What builtins need of the engine. Everything may be left out: without a console cvars are 0 and commands go nowhere,
// without files none is found, without `rng` random() begins at the same number each time.
struct Services {
  con::Console* console = nullptr;
  // FRIK_FILE: names as fs/path.h has them, all below data/ but for reading. Usually fs::ModFiles::read and ::write.
  FileLoader read_file;
  std::function<Status(std::string_view name, ByteView data)> write_file;
  // Called with the table's end if something was written: it need not be on the disk before.
  std::function<void()> flush_files;
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
