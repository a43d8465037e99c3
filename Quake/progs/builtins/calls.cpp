// Functions and fields by their names, and whole entities at once.
#include <algorithm>

#include "progs/builtins/kinds.h"
#include "progs/entity_text.h"
#include "progs/text_tokens.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

// kNull for builtins, which only statements call, and for what there is not.
FunctionId function_with_body(const Vm& vm, std::string_view name) {
  const FunctionId id = name.empty() ? FunctionId::kNull : vm.program().find_function(name);
  return id != FunctionId::kNull && vm.program().functions[index(id)].first_statement > 0 ? id : FunctionId::kNull;
}

// callfunction(parameters..., name): those before the name are the function's.
void callfunction(Vm& vm) {
  if (vm.parm_count() < 1) return vm.skip("callfunction without a name");
  const std::string name(vm.parm_string(vm.parm_count() - 1));
  const FunctionId function = function_with_body(vm, name);
  if (function == FunctionId::kNull) return vm.skip("callfunction: there is no function \"" + name + "\"");
  (void)vm.execute(function);  // what fails there has failed here, too
}

// copyentity(from, to): without `to`, to a new one.
void copyentity(Vm& vm) {
  const EdictId from = vm.parm_entity(0);
  EdictId to = vm.parm_count() > 1 ? vm.parm_entity(1) : EdictId::kWorld;
  if (vm.failed()) return;
  if (vm.parm_count() < 2) {
    const auto made = vm.edicts().alloc(vm.level_time);
    if (!made) return vm.fail(made.error().message);
    to = *made;
  }
  if ((to == EdictId::kWorld && vm.protect_world) || vm.edicts().is_free(to))
    return vm.skip("copyentity to what is no entity that QuakeC may write");
  std::copy_n(vm.edict(from).words(), vm.edicts().words_per_edict(), vm.edict(to).words());
  vm.return_edict(to);
}

// parseentitydata(entity, "{ "key" "value" ... }", where in it to begin): where it ends, or 0.
void parseentitydata(Vm& vm) {
  const EdictId id = vm.parm_entity(0);
  const std::string text(vm.parm_string(1));
  if (vm.failed() || (id == EdictId::kWorld && vm.protect_world)) return vm.return_float(0.0f);
  const auto start = vm.parm_count() > 2 ? static_cast<std::size_t>(std::max(0, vm.parm_int(2))) : 0;
  std::string_view rest = std::string_view(text).substr(std::min(start, text.size()));
  vm.return_float(0.0f);
  const auto brace = take_token(rest);
  if (!brace || !brace->is('{')) return;
  if (const auto read = parse_edict(vm, id, rest); !read) return vm.warn(read.error().message);
  vm.return_float(static_cast<float>(text.size() - rest.size()));
}

void findentityfield(Vm& vm) {
  const auto& fields = vm.program().field_definitions;
  const std::string_view name = vm.parm_string(0);
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.name == name; });
  vm.return_float(found == fields.end() ? 0.0f : static_cast<float>(found - fields.begin()));
}

}  // namespace

void add_call_builtins(BuiltinTable& table) {
  table.set(400, "copyentity", copyentity);
  table.add_extension("DP_QC_COPYENTITY");
  table.set(605, "callfunction", callfunction);
  table.set(607, "isfunction", [](Vm& vm) {
    vm.return_float(function_with_body(vm, vm.parm_string(0)) == FunctionId::kNull ? 0.0f : 1.0f);
  });
  table.set(613, "parseentitydata", parseentitydata);
  table.set_named("findentityfield", findentityfield);
  table.set_named("entityfieldref", [](Vm& vm) {
    const auto& fields = vm.program().field_definitions;
    const auto i = static_cast<std::size_t>(vm.parm_int(0));
    vm.return_word(i < fields.size() ? fields[i].offset : 0);
  });
}

}  // namespace fb::progs
