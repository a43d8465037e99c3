// FTE's integers: words that hold a whole number instead of a float. Programs of version 6 have no instructions for
// them, but may hand them on, print them (%i) and convert them by these.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

std::int32_t integer_parm(const Vm& vm, int i) { return static_cast<std::int32_t>(vm.parm_string_id(i)); }
void return_integer(Vm& vm, std::int32_t value) { vm.return_word(static_cast<Word>(value)); }

// Of C's base: 0 takes 0x for hexadecimal and 0 for octal. What does not fit is the nearest that does.
void return_parsed(Vm& vm, int base) {
  const std::string text(vm.parm_string(0));
  const long long value = std::strtoll(text.c_str(), nullptr, base);
  // Hexadecimal is often a set of bits, up to the topmost.
  const long long most = base == 16 ? UINT32_MAX : INT32_MAX;
  return_integer(vm, static_cast<std::int32_t>(std::clamp<long long>(value, INT32_MIN, most)));
}

}  // namespace

void add_integer_builtins(BuiltinTable& table) {
  table.set(259, "stoi", [](Vm& vm) { return_parsed(vm, 0); });
  table.set(260, "itos", [](Vm& vm) { vm.return_string(fmt::format("{}", integer_parm(vm, 0))); });
  table.set(261, "stoh", [](Vm& vm) { return_parsed(vm, 16); });
  table.set(262, "htos",
            [](Vm& vm) { vm.return_string(fmt::format("{:08x}", static_cast<std::uint32_t>(integer_parm(vm, 0)))); });
  table.set_named("ftoi", [](Vm& vm) { return_integer(vm, vm.parm_int(0)); });
  table.set_named("itof", [](Vm& vm) { vm.return_float(static_cast<float>(integer_parm(vm, 0))); });
  table.add_extension("FTE_QC_INTCONV");
}

}  // namespace fb::progs
