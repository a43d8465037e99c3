// Entities: making, removing and finding them. What needs the world (findradius, setmodel, ...) is the server's.
#include <fmt/format.h>

#include "progs/builtins/kinds.h"
#include "progs/entity_text.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

void spawn(Vm& vm) {
  const auto id = vm.edicts().alloc(vm.level_time);
  if (!id) return vm.fail(id.error().message);
  vm.return_edict(*id);
}

void remove(Vm& vm) {
  const EdictId id = vm.parm_entity(0);
  if (!vm.failed()) vm.edicts().free(id, vm.level_time);
}

void nextent(Vm& vm) {
  for (EdictId id = next(vm.parm_entity(0)); vm.edicts().valid(id); id = next(id)) {
    if (!vm.edicts().is_free(id)) return vm.return_edict(id);
  }
  vm.return_edict(EdictId::kWorld);
}

// The first edict behind parameter 0 that `matches`; the world where there is none.
template <typename Matches>
void find_next(Vm& vm, const Matches& matches) {
  for (EdictId id = next(vm.parm_entity(0)); !vm.failed() && vm.edicts().valid(id); id = next(id)) {
    if (!vm.edicts().is_free(id) && matches(vm.edict(id))) return vm.return_edict(id);
  }
  vm.return_edict(EdictId::kWorld);
}

// All that match, linked through a field of type entity: .chain, or what the parameter `chain_parm` names.
template <typename Matches>
void find_chain(Vm& vm, int chain_parm, const Matches& matches) {
  const Field<EdictId> chain = vm.parm_count() > chain_parm ? vm.parm_field<EdictId>(chain_parm) : fields::chain;
  EdictId head = EdictId::kWorld;
  for (EdictId id{1}; !vm.failed() && vm.edicts().valid(id); id = next(id)) {
    Edict edict = vm.edict(id);
    if (edict.is_free() || !matches(edict)) continue;
    edict.set(chain, head);
    head = id;
  }
  vm.return_edict(head);
}

// What an edict is asked for: parameter `field_parm` names the field, the next one the value.
auto string_match(Vm& vm, int field_parm) {
  return [&vm, field = vm.parm_field<StringId>(field_parm),
          text = std::string(vm.parm_string(field_parm + 1))](const Edict& edict) {
    const char* const value = vm.strings().c_str(edict.get(field));
    return value && text == value;
  };
}
auto float_match(Vm& vm, int field_parm) {
  return [field = vm.parm_field<float>(field_parm), value = vm.parm_float(field_parm + 1)](const Edict& edict) {
    return edict.get(field) == value;
  };
}
auto flag_match(Vm& vm, int field_parm) {
  return [field = vm.parm_field<float>(field_parm), bits = vm.parm_int(field_parm + 1)](const Edict& edict) {
    return edict.has_flag(field, bits);
  };
}

}  // namespace

void add_entity_builtins(BuiltinTable& table) {
  table.set(14, "spawn", spawn);
  table.set(15, "remove", remove);
  table.set(47, "nextent", nextent);
  table.set(18, "find", [](Vm& vm) { find_next(vm, string_match(vm, 1)); });
  table.set(98, "findfloat", [](Vm& vm) { find_next(vm, float_match(vm, 1)); });
  table.add_extension("DP_QC_FINDFLOAT");
  table.set(449, "findflags", [](Vm& vm) { find_next(vm, flag_match(vm, 1)); });
  table.add_extension("DP_QC_FINDFLAGS");
  table.set(402, "findchain", [](Vm& vm) { find_chain(vm, 2, string_match(vm, 0)); });
  table.add_extension("DP_QC_FINDCHAIN");
  table.set(403, "findchainfloat", [](Vm& vm) { find_chain(vm, 2, float_match(vm, 0)); });
  table.add_extension("DP_QC_FINDCHAINFLOAT");
  table.set(450, "findchainflags", [](Vm& vm) { find_chain(vm, 2, flag_match(vm, 0)); });
  table.add_extension("DP_QC_FINDCHAINFLAGS");
  table.set(353, "wasfreed", [](Vm& vm) { vm.return_float(vm.parm_edict(0).is_free() ? 1.0f : 0.0f); });
  const auto number_of = [](Vm& vm) { vm.return_float(static_cast<float>(index(vm.parm_entity(0)))); };
  const auto edict_of = [](Vm& vm) {
    const EdictId id{static_cast<std::uint32_t>(vm.parm_int(0))};
    vm.return_edict(vm.edicts().valid(id) ? id : EdictId::kWorld);
  };
  table.set(512, "num_for_edict", number_of);
  table.set_named("etof", number_of);
  table.add_extension("DP_QC_NUM_FOR_EDICT");
  table.set(459, "edict_num", edict_of);
  table.set_named("ftoe", edict_of);
  table.add_extension("DP_QC_EDICT_NUM");
}

// DP_QC_ENTITYDATA: the mod's fields by number, and their values as text.
void add_entity_data_builtins(BuiltinTable& table) {
  const auto definition = [](Vm& vm) -> const Definition* {
    const auto i = static_cast<std::size_t>(vm.parm_int(0));
    const auto& definitions = vm.program().field_definitions;
    return i < definitions.size() ? &definitions[i] : nullptr;
  };
  table.set(496, "numentityfields",
            [](Vm& vm) { vm.return_float(static_cast<float>(vm.program().field_definitions.size())); });
  table.set(497, "entityfieldname", [definition](Vm& vm) {
    const Definition* field = definition(vm);
    vm.return_string(field ? field->name : std::string_view());
  });
  table.set(498, "entityfieldtype", [definition](Vm& vm) {
    const Definition* field = definition(vm);
    vm.return_float(field ? static_cast<float>(field->type) : 0.0f);
  });
  table.set(499, "getentityfieldstring", [definition](Vm& vm) {
    const Definition* field = definition(vm);
    Edict edict = vm.parm_edict(1);
    vm.return_string(field ? saved_text(vm, field->type, edict.words() + field->offset) : std::string());
  });
  table.set(500, "putentityfieldstring", [definition](Vm& vm) {
    const Definition* field = definition(vm);
    Edict edict = vm.parm_edict(1);
    const std::string text(vm.parm_string(2));
    const bool may = !vm.failed() && field && !(edict.is_world() && vm.protect_world);
    vm.return_float(may && set_from_text(vm, *field, edict.words() + field->offset, text).ok() ? 1.0f : 0.0f);
  });
  table.add_extension("DP_QC_ENTITYDATA");
}

}  // namespace fb::progs
