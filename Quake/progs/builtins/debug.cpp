// What helps a mod's author: errors, prints of edicts, tracing.
#include <fmt/format.h>

#include "progs/builtins/kinds.h"
#include "progs/builtins/output.h"
#include "progs/entity_text.h"
#include "progs/vm.h"

namespace fb::progs {

void add_debug_builtins(BuiltinTable& table, const Services& services) {
  const auto print = output_of(services);
  const auto print_error = [print](Vm& vm, std::string_view what, std::string_view text) {
    print(fmt::format("======{} ERROR in {}:\n{}\n{}", what, vm.function_name(vm.current_function()), text,
                      print_edict(vm, vm.self().id())));
  };
  const con::Localization* const texts = localization_of(services);
  table.set(10, "error", [print_error, texts](Vm& vm) {
    const std::string text = message_text(vm, 0, texts);
    print_error(vm, "SERVER", text);
    vm.fail(fmt::format("the mod gives up: {}", text));
  });
  // Not the end of the game, only of the entity, as in QuakeSpasm.
  table.set(11, "objerror", [print_error, texts](Vm& vm) {
    print_error(vm, "OBJECT", message_text(vm, 0, texts));
    vm.edicts().free(vm.self().id(), vm.level_time);
  });
  table.set(6, "break", [](Vm& vm) { vm.fail("break statement"); });
  table.set(28, "coredump", [print](Vm& vm) {
    for (EdictId id{}; vm.edicts().valid(id); id = next(id)) print(print_edict(vm, id));
  });
  table.set(29, "traceon", [](Vm& vm) { vm.set_trace(true); });
  table.set(30, "traceoff", [](Vm& vm) { vm.set_trace(false); });
  table.set(31, "eprint", [print](Vm& vm) {
    const EdictId id = vm.parm_entity(0);
    if (!vm.failed()) print(print_edict(vm, id));
  });
}

}  // namespace fb::progs
