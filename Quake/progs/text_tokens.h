// Words and numbers of text as Quake's C code reads them: entity lumps, saved games, QuakeC's stof and its like.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <cstdint>

#include "base/maths.h"

namespace fb::progs {

struct Token {
  std::string text;
  bool quoted = false;
  bool is(char c) const { return !quoted && text.size() == 1 && text[0] == c; }
};

// Takes the next word off the front of `text` (Quake's COM_Parse): what stands in quotes, without escapes; one of
// { } ( ) ' or, where a word begins, a colon; else up to white space or one of the former. // and /* */ are comments.
// nullopt at the end.
std::optional<Token> take_token(std::string_view& text);

// C's atof: the number that the text begins with, else 0.
float parse_float(std::string_view text);
// C's atoi, without overflowing.
std::int32_t parse_int(std::string_view text);
// Three numbers with one space between, as Quake reads entities' vectors: a second space is a number of its own, 0.
vec3 parse_spaced_vector(std::string_view text);

// Numbers as C's printf writes them, with what are none: "  1.5" (%5.1f), "1.500000" (%f), "'  1.0   2.0   3.0'".
std::string one_decimal(float value);
std::string six_decimals(float value);
std::string vector_text(const vec3& v);

}  // namespace fb::progs
