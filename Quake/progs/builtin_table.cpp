#include "progs/builtin_table.h"

#include <fmt/format.h>

#include "base/check.h"
#include "base/log.h"
#include "progs/vm.h"

namespace fb::progs {

void BuiltinTable::set(std::uint32_t number, std::string_view name, Builtin builtin) {
  FB_CHECK(number > 0 && number <= kMaxNumber);
  if (number >= entries_.size()) entries_.resize(number + 1);
  entries_[number] = {std::string(name), std::move(builtin), false};
  numbers_[std::string(name)] = number;
}

std::uint32_t BuiltinTable::set_named(std::string_view name, Builtin builtin) {
  set(next_named_, name, std::move(builtin));
  return next_named_++;
}

std::uint32_t BuiltinTable::set_named_idle(std::string_view name) {
  set_idle(next_named_, name);
  return next_named_++;
}

void BuiltinTable::set_idle(std::uint32_t number, std::string_view name) {
  set(number, name, [name = std::string(name)](Vm& vm) {
    log_debug("{}: does nothing here", name);
    vm.return_float(0.0f);
  });
  entries_[number].idle = true;
}

std::vector<std::uint32_t> BuiltinTable::numbers() const {
  std::vector<std::uint32_t> all;
  for (std::uint32_t number = 0; number < entries_.size(); ++number)
    if (entries_[number].builtin) all.push_back(number);
  return all;
}

const Builtin* BuiltinTable::find(std::uint32_t number) const {
  if (number >= entries_.size() || !entries_[number].builtin) return nullptr;
  return &entries_[number].builtin;
}

void BuiltinTable::set_alias(std::uint32_t number, std::string_view name, std::uint32_t meant) {
  aliases_[{number, std::string(name)}] = meant;
}

std::uint32_t BuiltinTable::resolve(std::int64_t declared, std::string_view name) const {
  if (declared < 0 || declared > kMaxNumber) return 0;
  auto number = static_cast<std::uint32_t>(declared);
  const auto alias = aliases_.find({number, std::string(name)});
  if (alias != aliases_.end()) {
    number = alias->second;
  } else if (number == 0) {
    const auto named = numbers_.find(std::string(name));
    if (named != numbers_.end()) number = named->second;
  }
  return find(number) ? number : 0;
}

std::uint32_t BuiltinTable::number_of(std::string_view name) const {
  const std::uint32_t number = resolve(0, name);
  return is_idle(number) ? 0 : number;
}

std::string builtin_label(std::int64_t number, std::string_view name) {
  if (number == 0) return name.empty() ? "a builtin without number and name" : fmt::format("the builtin {}", name);
  return name.empty() ? fmt::format("builtin #{}", number) : fmt::format("builtin #{} ({})", number, name);
}

std::string_view BuiltinTable::name_of(std::uint32_t number) const {
  return number < entries_.size() ? std::string_view(entries_[number].name) : std::string_view();
}

}  // namespace fb::progs
