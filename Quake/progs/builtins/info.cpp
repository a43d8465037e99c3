// Info strings, \key\value\key\value, of FTE_STRINGS.
#include <utility>
#include <vector>

#include "progs/builtins/kinds.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

std::string_view take_part(std::string_view& text) {
  if (text.starts_with('\\')) text.remove_prefix(1);
  const std::string_view part = text.substr(0, text.find('\\'));
  text.remove_prefix(part.size());
  return part;
}

Pairs parse_info(std::string_view text) {
  Pairs pairs;
  while (!text.empty()) {
    const std::string key(take_part(text));
    pairs.emplace_back(key, take_part(text));
  }
  return pairs;
}

bool fits(std::string_view text) { return text.find_first_of("\\\"") == std::string_view::npos; }

// infoadd(info, key, value...): replaces the key's value, or with "" takes it away. What holds a backslash or a quote
// changes nothing.
void infoadd(Vm& vm) {
  const std::string_view info = vm.parm_string(0), key = vm.parm_string(1);
  const std::string value = vm.parm_text_from(2);
  if (key.empty() || !fits(key) || !fits(value)) return vm.return_string(info);
  std::string result;
  const auto add = [&](std::string_view k, std::string_view v) {
    result.append("\\").append(k).append("\\").append(v);
  };
  for (const auto& [k, v] : parse_info(info)) {
    if (k != key) add(k, v);
  }
  if (!value.empty()) add(key, value);
  vm.return_string(result);
}

void infoget(Vm& vm) {
  const std::string_view key = vm.parm_string(1);
  for (const auto& [k, v] : parse_info(vm.parm_string(0))) {
    if (k == key) return vm.return_string(v);
  }
  vm.return_string("");
}

}  // namespace

void add_info_builtins(BuiltinTable& table) {
  table.set(226, "infoadd", infoadd);
  table.set(227, "infoget", infoget);
}

}  // namespace fb::progs
