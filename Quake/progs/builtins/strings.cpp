// Strings: Quake's own conversions and the core of FTE_STRINGS. Characters are bytes.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "progs/builtins/kinds.h"
#include "progs/text_tokens.h"
#include "progs/vm.h"

namespace fb::progs {
namespace {

// Whole numbers as such, others with one decimal in at least five places.
void ftos(Vm& vm) {
  const float value = vm.parm_float(0);
  const std::int32_t whole = to_int(value);
  vm.return_string(value == static_cast<float>(whole) ? fmt::format("{}", whole) : one_decimal(value));
}

void vtos(Vm& vm) { vm.return_string(vector_text(vm.parm_vector(0))); }

// "1 2 3", with the quotes of vtos or without.
void stov(Vm& vm) {
  const std::string text(vm.parm_string(0));
  const char* at = text.c_str();
  while (std::isspace(static_cast<unsigned char>(*at)) || *at == '\'') ++at;
  vec3 v(0.0f);
  for (int i = 0; i < 3; ++i) {
    char* end = nullptr;
    v[i] = static_cast<float>(std::strtod(at, &end));
    if (end == at) break;
    at = end;
  }
  vm.return_vector(v);
}

// A negative start counts from the end; a negative length goes up to so many before the end (-1: to the end).
void substring(Vm& vm) {
  const std::string_view text = vm.parm_string(0);
  const auto size = static_cast<std::int64_t>(text.size());
  std::int64_t start = vm.parm_int(1), length = vm.parm_int(2);
  if (start < 0) start += size;
  if (length < 0) length += size - start + 1;
  start = std::max<std::int64_t>(start, 0);
  if (start >= size || length <= 0) return vm.return_string("");
  vm.return_string(text.substr(static_cast<std::size_t>(start), static_cast<std::size_t>(length)));
}

void strzone(Vm& vm) {
  const StringId id = vm.strings().zone(vm.parm_text_from(0));
  if (id == StringId::kNull) vm.warn("too many strings (strzone without strunzone): this one is empty");
  vm.return_string_id(id);
}

// What is no zone string is left alone: mods give back constants, too.
void strunzone(Vm& vm) {
  if (vm.parm_string_id(0) == StringId::kNull) return;
  (void)vm.parm_string(0);  // warns of what is no string at all, as one that was given back already
  if (!vm.failed()) vm.strings().unzone(vm.parm_string_id(0));
}

// Where the second string is in the first, from an offset on; -1 where it is not.
void strstrofs(Vm& vm) {
  const std::string_view text = vm.parm_string(0), part = vm.parm_string(1);
  const std::int32_t from = vm.parm_count() > 2 ? vm.parm_int(2) : 0;
  if (from < 0 || static_cast<std::size_t>(from) > text.size()) return vm.return_float(-1.0f);
  const std::size_t at = text.find(part, static_cast<std::size_t>(from));
  vm.return_float(at == std::string_view::npos ? -1.0f : static_cast<float>(at));
}

// The character at an offset (negative: from the end); 0 outside.
void str2chr(Vm& vm) {
  const std::string_view text = vm.parm_string(0);
  std::int64_t at = vm.parm_count() > 1 ? vm.parm_int(1) : 0;
  if (at < 0) at += static_cast<std::int64_t>(text.size());
  const bool inside = at >= 0 && at < static_cast<std::int64_t>(text.size());
  vm.return_float(inside ? static_cast<float>(static_cast<unsigned char>(text[static_cast<std::size_t>(at)])) : 0.0f);
}

void chr2str(Vm& vm) {
  std::string text;
  for (int i = 0; i < vm.parm_count(); ++i) text += static_cast<char>(vm.parm_int(i));
  vm.return_string(text);
}

unsigned char folded(char c) { return static_cast<unsigned char>(std::tolower(static_cast<unsigned char>(c))); }
unsigned char plain(char c) { return static_cast<unsigned char>(c); }

// -1, 0 or 1. The optional third parameter is how many characters count, the fourth and fifth where to begin.
template <unsigned char kEqual(char)>
void compare(Vm& vm) {
  std::array<std::string_view, 2> texts = {vm.parm_string(0), vm.parm_string(1)};
  const auto optional = [&](int i, std::size_t otherwise) {
    return vm.parm_count() > i ? static_cast<std::size_t>(std::max(0, vm.parm_int(i))) : otherwise;
  };
  for (std::size_t i = 0; i < 2; ++i) {
    texts[i].remove_prefix(std::min(texts[i].size(), optional(3 + static_cast<int>(i), 0)));
    texts[i] = texts[i].substr(0, optional(2, std::string_view::npos));
  }
  const auto order =
      std::lexicographical_compare_three_way(texts[0].begin(), texts[0].end(), texts[1].begin(), texts[1].end(),
                                             [](char a, char b) { return kEqual(a) <=> kEqual(b); });
  vm.return_float(order < 0 ? -1.0f : order > 0 ? 1.0f : 0.0f);
}

}  // namespace

void add_string_builtins(BuiltinTable& table) {
  table.set(26, "ftos", ftos);
  table.set(27, "vtos", vtos);
  table.set(65, "etos", [](Vm& vm) { vm.return_string(fmt::format("entity {}", index(vm.parm_entity(0)))); });
  table.add_extension("DP_QC_ETOS");
  table.set(81, "stof", [](Vm& vm) { vm.return_float(parse_float(vm.parm_string(0))); });
  table.set(114, "strlen", [](Vm& vm) { vm.return_float(static_cast<float>(vm.parm_string(0).size())); });
  table.set(115, "strcat", [](Vm& vm) { vm.return_string(vm.parm_text_from(0)); });
  table.set(116, "substring", substring);
  table.set(117, "stov", stov);
  table.set(118, "strzone", strzone);
  table.set(119, "strunzone", strunzone);
  table.set(221, "strstrofs", strstrofs);
  table.set(222, "str2chr", str2chr);
  table.set(223, "chr2str", chr2str);
  table.set(228, "strncmp", compare<plain>);
  table.set(229, "strcasecmp", compare<folded>);
  table.set(230, "strncasecmp", compare<folded>);
}

}  // namespace fb::progs
