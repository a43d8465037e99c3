// The table of builtins: what QuakeC's functions without a body do. One table belongs to one virtual machine; some
// builtins (files, tokenize) keep their state in it.
//
//   BuiltinTable table = standard_builtins(services);       // everything that needs no server: builtins/builtins.h
//   table.set(2, "setorigin", [&server](Vm& vm) { ... });   // the server's own
//   table.add_extension("FTE_SV_POINTPARTICLES");           // what checkextension answers for
//   auto vm = Vm::create(program, std::move(table), options);
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace fb::progs {

class Vm;

// Reads its parameters with vm.parm_*(i), answers with vm.return_*(...), and fails with vm.fail(sentence): QuakeC ends
// as the builtin returns. Reading a parameter that makes no sense fails the same way and gives zero, "" or the world.
using Builtin = std::function<void(Vm&)>;

class BuiltinTable {
 public:
  static constexpr std::uint32_t kMaxNumber = 4095;

  // Replaces what has that number. The name is what #0:name and error messages call it.
  void set(std::uint32_t number, std::string_view name, Builtin builtin);
  // One that QuakeC knows by its name only (`= #0:name`). It gets a number that no mod uses, which is returned.
  std::uint32_t set_named(std::string_view name, Builtin builtin);
  // One that mods may call, but that does nothing and returns 0 here.
  void set_idle(std::uint32_t number, std::string_view name);
  std::uint32_t set_named_idle(std::string_view name);
  // What a program means by a builtin of this number and name is the one numbered `meant`: the 2021 re-release has
  // numbers that mean something else to others, who name them differently. Number 0: `= #0:name`.
  void set_alias(std::uint32_t number, std::string_view name, std::uint32_t meant);
  bool is_idle(std::uint32_t number) const { return number < entries_.size() && entries_[number].idle; }
  // nullptr where there is none.
  const Builtin* find(std::uint32_t number) const;
  // The number of what a program declares with this number (0: `= #0:name`) and name; 0 where it is not known.
  std::uint32_t resolve(std::int64_t number, std::string_view name) const;
  // 0 where there is none, or none but one that does nothing.
  std::uint32_t number_of(std::string_view name) const;
  std::string_view name_of(std::uint32_t number) const;

  void add_extension(std::string_view name) { extensions_.emplace(name); }
  bool has_extension(std::string_view name) const { return extensions_.contains(name); }
  const std::set<std::string, std::less<>>& extensions() const { return extensions_; }
  // Numbers of all builtins, in order.
  std::vector<std::uint32_t> numbers() const;
  // Whether a number is one that set_named has given.
  static bool is_named_only(std::uint32_t number) { return number >= kFirstNamed; }

 private:
  static constexpr std::uint32_t kFirstNamed = 3072;
  struct Entry {
    std::string name;
    Builtin builtin;
    bool idle = false;
  };
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> aliases_;
  std::set<std::string, std::less<>> extensions_;
  std::uint32_t next_named_ = kFirstNamed;
};

// For sentences: "builtin #90 (tracebox)", "builtin #90", "the builtin ex_bprint" (number 0).
std::string builtin_label(std::int64_t number, std::string_view name);

}  // namespace fb::progs
