// The entity lump of a map (or an external .ent file): text of brace-enclosed lists of "key" "value" pairs, read as
// leniently as Quake's COM_Parse reads it, and the helpers that turn values into numbers, vectors and colours.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/maths.h"
#include "base/result.h"

namespace fb::world {

struct Entity {
  std::map<std::string, std::string, std::less<>> values;  // of a key given twice the last is used

  std::string_view classname() const { return text("classname"); }
  bool has(std::string_view key) const { return values.find(key) != values.end(); }
  // The value, or empty.
  std::string_view text(std::string_view key) const;
  // The number at the start of the value, as atof would read it; the fallback if there is none.
  float number(std::string_view key, float fallback) const;
  int integer(std::string_view key, int fallback) const;
  std::optional<vec3> vector(std::string_view key) const;  // nullopt unless there are three numbers
  // A colour in 0..1. Maps use 0..1 or 0..255: a value with a component above 1 is taken as the latter.
  std::optional<vec3> color(std::string_view key) const;
};

// `name` is the text's name in errors. Errors: text outside braces, a key without a value, a missing brace.
Result<std::vector<Entity>> parse_entity_lump(std::string_view text, std::string_view name);

// Reads up to `most` numbers separated by white space; stops at the first word that is not a number. All are finite.
std::vector<float> parse_numbers(std::string_view text, std::size_t most);

}  // namespace fb::world
