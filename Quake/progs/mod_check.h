// What a mod's program asks an engine for, read off its statements without running it: builtins that it calls,
// extensions and cvars whose names it has as constants, functions that some engine calls by their names. And the
// sentences about what of these is missing here (the console's modcheck).
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "progs/builtin_table.h"
#include "progs/program.h"

namespace fb::progs {

struct ModNeeds {
  struct Call {
    std::int64_t number = 0;  // 0: known by its name
    std::string name;         // as the mod calls it; may be empty
    auto operator<=>(const Call&) const = default;
  };
  std::set<Call> builtins;
  std::set<std::string> extensions;             // of checkextension
  std::set<std::string> cvars_read, cvars_set;  // without those that it registers itself
};
ModNeeds needs_of(const Program& program);

// What a program is checked against.
struct ModHost {
  const BuiltinTable& builtins;
  std::function<bool(std::string_view name)> has_cvar;
  std::vector<std::string_view> must_have;     // functions that are called here, and must be there
  std::vector<std::string_view> never_called;  // functions of other engines
};
// One for each thing that is missing; none where nothing is. Each begins with the program's file.
std::vector<std::string> missing_here(const Program& program, const ModHost& host);

// For ModHost: Quake's own functions of a server, and those that only other engines call.
std::vector<std::string_view> server_functions();
std::vector<std::string_view> server_functions_of_other_engines();
std::vector<std::string_view> client_functions_of_other_engines();

}  // namespace fb::progs
