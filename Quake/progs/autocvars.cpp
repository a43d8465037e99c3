#include "progs/autocvars.h"

#include <fmt/format.h>

#include "console/console.h"
#include "progs/text_tokens.h"

namespace fb::progs {
namespace {

constexpr std::string_view kPrefix = "autocvar_";

std::string default_text(const Vm& vm, const Definition& global) {
  const Word* words = vm.globals_data() + global.offset;
  if (global.type == Type::kFloat) return fmt::format("{:g}", as_float(*words));
  if (global.type == Type::kString) return std::string(vm.text(static_cast<StringId>(*words)));
  return fmt::format("{:g} {:g} {:g}", as_float(words[0]), as_float(words[1]), as_float(words[2]));
}

}  // namespace

Autocvars::Autocvars(Vm& vm, con::Console& console) : vm_(vm), console_(console) {
  std::uint32_t components_end = 0;  // of the last vector: compilers define its components, too
  for (const Definition& global : vm.program().global_definitions) {
    if (!global.name.starts_with(kPrefix) || global.name.size() == kPrefix.size()) continue;
    if (global.type != Type::kFloat && global.type != Type::kString && global.type != Type::kVector) continue;
    if (global.type == Type::kFloat && global.offset < components_end && global.offset + 3 >= components_end) continue;
    if (global.type == Type::kVector) components_end = global.offset + 3;
    const std::string name(global.name.substr(kPrefix.size()));
    if (!console.find_cvar(name)) {
      if (console.has_command(name)) continue;
      console.add_cvar(name, default_text(vm, global), "made by the mod", con::kCvarUser);
    }
    bound_.push_back({global, name, default_text(vm, global)});
  }
  refresh();
}

void Autocvars::refresh() {
  for (Bound& bound : bound_) {
    const con::Cvar* cvar = console_.find_cvar(bound.cvar);
    if (!cvar || cvar->string() == bound.value) continue;
    bound.value = cvar->string();
    Word* words = vm_.globals_data() + bound.global.offset;
    if (bound.global.type == Type::kFloat)
      *words = as_word(cvar->value());
    else if (bound.global.type == Type::kString)
      *words = static_cast<Word>(vm_.strings().intern(bound.value));
    else
      ValueTraits<vec3>::store(words, parse_spaced_vector(bound.value));
  }
}

}  // namespace fb::progs
