#include "progs/text_tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "progs/value.h"

namespace fb::progs {
namespace {

bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }
bool is_mark(char c) { return std::string_view("{}()'").find(c) != std::string_view::npos; }

// What fmt's own formats write alike, but for numbers that are none.
std::string printed(const char* format, float value) {
  char buffer[64];  // the greatest float has 39 digits
  const int length = std::snprintf(buffer, sizeof(buffer), format, static_cast<double>(value));
  return {buffer, static_cast<std::size_t>(length)};
}

void skip_blanks_and_comments(std::string_view& text) {
  for (;;) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    std::size_t end;
    if (text.starts_with("//")) {
      end = text.find('\n');
    } else if (text.starts_with("/*")) {
      end = text.find("*/", 2);
      if (end != std::string_view::npos) end += 2;
    } else {
      return;
    }
    text.remove_prefix(std::min(end, text.size()));
  }
}

}  // namespace

std::optional<Token> take_token(std::string_view& text) {
  skip_blanks_and_comments(text);
  if (text.empty()) return std::nullopt;
  if (text.front() == '"') {
    const std::size_t end = std::min(text.find('"', 1), text.size());
    Token token{std::string(text.substr(1, end - 1)), true};
    text.remove_prefix(std::min(end + 1, text.size()));
    return token;
  }
  std::size_t length = 1;
  if (!is_mark(text.front()) && text.front() != ':') {
    while (length < text.size() && !is_space(text[length]) && !is_mark(text[length])) ++length;
  }
  Token token{std::string(text.substr(0, length)), false};
  text.remove_prefix(length);
  return token;
}

float parse_float(std::string_view text) { return static_cast<float>(std::strtod(std::string(text).c_str(), nullptr)); }

std::int32_t parse_int(std::string_view text) {
  const long long value = std::strtoll(std::string(text).c_str(), nullptr, 10);
  return static_cast<std::int32_t>(std::clamp<long long>(value, INT32_MIN, INT32_MAX));
}

vec3 parse_spaced_vector(std::string_view text) {
  vec3 v(0.0f);
  for (int i = 0; i < 3; ++i) {
    const std::size_t space = text.find(' ');
    v[i] = parse_float(text.substr(0, space));
    if (space == std::string_view::npos) break;
    text.remove_prefix(space + 1);
  }
  return v;
}

std::string one_decimal(float value) { return printed("%5.1f", value); }
std::string six_decimals(float value) { return printed("%f", value); }

std::string vector_text(const vec3& v) {
  return fmt::format("'{} {} {}'", one_decimal(v.x), one_decimal(v.y), one_decimal(v.z));
}

}  // namespace fb::progs
