#include "progs/builtin_table.h"

#include "base/check.h"
#include "base/log.h"
#include "progs/vm.h"

namespace fb::progs {

void BuiltinTable::set(std::uint32_t number, std::string_view name, Builtin builtin) {
  FB_CHECK(number > 0 && number <= kMaxNumber);
  if (number >= entries_.size()) entries_.resize(number + 1);
  entries_[number] = {std::string(name), std::move(builtin)};
  numbers_[std::string(name)] = number;
}

void BuiltinTable::set_named(std::string_view name, Builtin builtin) { set(next_named_++, name, std::move(builtin)); }

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

std::uint32_t BuiltinTable::number_of(std::string_view name) const {
  const auto found = numbers_.find(std::string(name));
  return found == numbers_.end() ? 0 : found->second;
}

std::string_view BuiltinTable::name_of(std::uint32_t number) const {
  return number < entries_.size() ? std::string_view(entries_[number].name) : std::string_view();
}

}  // namespace fb::progs
