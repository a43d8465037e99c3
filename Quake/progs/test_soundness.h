// What a program that was loaded must stand: its promises hold, and running any of its functions ends. For tests and
// the fuzzer.
#pragma once

#include <memory>
#include <string>

#include "base/check.h"
#include "progs/builtins/builtins.h"
#include "progs/vm.h"

namespace fb::progs::testing {

// What is broken, or "".
inline std::string broken(const Program& program) {
  if (program.strings.empty() || program.strings.back() != 0) return "strings without an end";
  if (program.globals.size() != program.global_count + kGlobalPadding) return "globals without padding";
  if (program.statements.empty() || program.statements.back().op != Op::kEnd) return "statements without an end";
  for (const Definition& field : program.field_definitions) {
    if (field.offset + words_of(field.type) > program.field_words) return "a field outside of the edicts";
  }
  for (const Definition& global : program.global_definitions) {
    if (global.offset + words_of(global.type) > program.global_count) return "a global outside of the globals";
  }
  VmOptions options;
  options.max_edicts = 8;
  options.max_statements = 2000;
  options.max_depth = 20;
  options.max_local_words = 1000;
  const std::shared_ptr<const Program> borrowed(std::shared_ptr<void>(), &program);
  auto vm = Vm::create(borrowed, standard_builtins({}), options);
  if (!vm.ok()) return vm.error().message;
  (*vm)->edicts().start_level(1);
  for (std::uint32_t i = 0; i < program.functions.size() && i < 16; ++i) {
    (*vm)->set(globals::self, EdictId{1});
    (void)(*vm)->execute(FunctionId{i});
    if ((*vm)->running()) return "the machine did not come to rest";
  }
  return "";
}

}  // namespace fb::progs::testing
