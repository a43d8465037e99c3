// Saved games from anywhere: the header, then globals and edicts into a machine. What is taken must write a save that
// is taken again.
#include <cstdint>
#include <memory>

#include "base/check.h"
#include "base/log.h"
#include "server/fuzz_program.h"
#include "server/save_game.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  set_log_level(LogLevel::kError);
  static const std::shared_ptr<const progs::Program> program = sv::testing::fuzz_program();
  const auto save = sv::parse_save({reinterpret_cast<const char*>(data), size}, "fuzz.sav");
  if (!save) return 0;
  auto vm = progs::Vm::create(program, {}, {.max_edicts = 64});
  FB_CHECK(vm.ok());
  (*vm)->edicts().start_level(1);
  if (!sv::read_saved_entities(**vm, save->entities, "fuzz.sav")) return 0;
  std::string text = progs::write_globals(**vm);
  for (sv::EdictId id{}; (*vm)->edicts().valid(id); id = progs::next(id)) text += progs::write_edict(**vm, id);
  auto again = progs::Vm::create(program, {}, {.max_edicts = 64});
  FB_CHECK(again.ok());
  (*again)->edicts().start_level(1);
  const Status status = sv::read_saved_entities(**again, text, "again.sav");
  FB_CHECK(status.ok());
  return 0;
}
