// The lists of builtins of Misc/docs/quakec.md, which are QuakeC: read, compared with tables, and turned into calls.
// For tests.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "progs/builtin_table.h"

namespace fb::progs::testing {

struct ListedBuiltin {
  std::uint32_t number = 0;  // 0: known by its name only
  std::string name, declaration;
  std::vector<std::string> types;  // of the parameters; "..." is left out
};

// What stands in the list's chapters of these titles.
inline std::vector<ListedBuiltin> listed_builtins(const std::set<std::string>& titles) {
  std::ifstream page("Misc/docs/quakec.md");
  EXPECT_TRUE(page.is_open()) << "tests run in the root of the source tree";
  std::vector<ListedBuiltin> all;
  bool in_chapter = false, in_code = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) in_chapter = titles.contains(line.substr(line.find(' ') + 1));
    if (line.starts_with("```")) in_code = !in_code;
    if (!in_chapter || !in_code || line.starts_with("```")) continue;
    ListedBuiltin builtin;
    builtin.declaration = line;
    const std::size_t open = line.find('('), number = line.find(" = #"), close = line.rfind(") ", number);
    builtin.name = line.substr(close + 2, number - close - 2);
    builtin.number = static_cast<std::uint32_t>(std::stoul(line.substr(number + 4)));
    std::stringstream parms(line.substr(open + 1, close - open - 1));
    for (std::string parm; std::getline(parms, parm, ',');) {
      std::stringstream words(parm);
      std::string type;
      if (words >> type && type != "...") builtin.types.push_back(type);
    }
    all.push_back(builtin);
  }
  return all;
}

inline std::string declarations(const std::vector<ListedBuiltin>& builtins) {
  std::string text;
  for (const ListedBuiltin& builtin : builtins) text += builtin.declaration + "\n";
  return text;
}

// "name(1, '1 2 3', ...);", with the parameters that `special` has for this name, or else with something of each type.
inline std::string call_of(const ListedBuiltin& builtin, const std::map<std::string, std::string>& special) {
  const auto found = special.find(builtin.name);
  if (found != special.end()) return fmt::format("  {}({});\n", builtin.name, found->second);
  std::string parms;
  for (const std::string& type : builtin.types) {
    const char* value = type == "float"     ? "1"
                        : type == "vector"  ? "'1 2 3'"
                        : type == "string"  ? "\"a word\""
                        : type == "entity"  ? "world"
                        : type == ".string" ? "classname"
                                            : "health";
    parms += (parms.empty() ? "" : ", ") + std::string(value);
  }
  return fmt::format("  {}({});\n", builtin.name, parms);
}

// The list names what the table has, by its number, and nothing else. (The 6 is a word of newer compilers.)
inline void expect_listed(const std::vector<ListedBuiltin>& list, const BuiltinTable& table) {
  std::set<std::string> listed, there;
  for (const ListedBuiltin& builtin : list)
    listed.insert(fmt::format("{} #{}", builtin.number == 6 ? "break" : builtin.name, builtin.number));
  for (const std::uint32_t number : table.numbers())
    there.insert(fmt::format("{} #{}", table.name_of(number), BuiltinTable::is_named_only(number) ? 0u : number));
  EXPECT_EQ(listed, there);
}

}  // namespace fb::progs::testing
