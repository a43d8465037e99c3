#include "console/args.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>

namespace fb::con {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }
bool stands_alone(char c) { return c == '{' || c == '}' || c == '(' || c == ')' || c == '\''; }

// The position after the comment that starts at `at`; `at` itself if there is none.
std::size_t skip_comment(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) == "/*") {
    const std::size_t line_end = std::min(text.find('\n', at), text.size());
    const std::size_t end = text.find("*/", at + 2);
    return end < line_end ? end + 2 : line_end;
  }
  return at;
}

}  // namespace

std::size_t command_end(std::string_view text, std::size_t start) {
  bool quoted = false, word_starts = true;
  std::size_t at = start;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '\n' || (c == ';' && !quoted)) return at;
    if (!quoted && word_starts) {
      if (const std::size_t after = skip_comment(text, at); after != at) {
        at = after;
        continue;
      }
    }
    if (c == '"') quoted = !quoted;
    word_starts = is_space(c) || stands_alone(c) || c == '"';
    ++at;
  }
  return at;
}

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? '\'' : c == '\n' || c == '\r' ? ' ' : c;
  return result + '"';
}

Args::Args(std::string_view line) {
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_space(line[at])) ++at;
    if (const std::size_t after = skip_comment(line, at); after != at) {
      at = after;
      continue;
    }
    if (at >= line.size()) break;
    if (words_.size() == 1) rest_ = line.substr(at);
    const std::size_t start = at;
    if (line[at] == '"') {
      const std::size_t close = std::min(line.find('"', at + 1), line.size());
      words_.emplace_back(line.substr(at + 1, close - at - 1));
      at = std::min(close + 1, line.size());
    } else if (stands_alone(line[at]) || line[at] == ':') {
      words_.emplace_back(1, line[at++]);
    } else {
      while (at < line.size() && !is_space(line[at]) && !stands_alone(line[at])) ++at;
      words_.emplace_back(line.substr(start, at - start));
    }
  }
  while (!rest_.empty() && is_space(rest_.back())) rest_.pop_back();
}

std::string Args::joined(std::size_t i) const {
  std::string text;
  for (std::size_t k = i; k < words_.size(); ++k) {
    if (k > i) text += ' ';
    text += words_[k];
  }
  return text;
}

float Args::number(std::size_t i) const { return std::strtof((*this)[i].c_str(), nullptr); }

int Args::integer(std::size_t i) const {
  const double value = std::strtod((*this)[i].c_str(), nullptr);
  if (std::isnan(value)) return 0;
  return static_cast<int>(std::clamp(value, static_cast<double>(INT_MIN), static_cast<double>(INT_MAX)));
}

const std::string& Args::nothing() {
  static const std::string empty;
  return empty;
}

bool NameLess::operator()(std::string_view a, std::string_view b) const {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](char x, char y) { return lower(x) < lower(y); });
}

bool same_name(std::string_view a, std::string_view b) { return a.size() == b.size() && name_starts_with(a, b); }

bool name_starts_with(std::string_view name, std::string_view prefix) {
  return prefix.size() <= name.size() &&
         std::equal(prefix.begin(), prefix.end(), name.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

bool name_contains(std::string_view name, std::string_view part) {
  return std::search(name.begin(), name.end(), part.begin(), part.end(),
                     [](char x, char y) { return lower(x) == lower(y); }) != name.end();
}

}  // namespace fb::con
