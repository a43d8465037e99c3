#include "fs/path.h"

#include <algorithm>
#include <cstddef>

namespace fb::fs {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::optional<std::string> normalise(std::string_view name) {
  std::string result;
  result.reserve(name.size());
  if (!name.empty() && (name.front() == '/' || name.front() == '\\')) return std::nullopt;
  std::size_t start = 0;
  while (start < name.size()) {
    const std::size_t end = std::min(name.find_first_of("/\\", start), name.size());
    const std::string_view part = name.substr(start, end - start);
    start = end + 1;
    if (part.empty() || part == ".") continue;
    if (part == "..") return std::nullopt;
    for (const char c : part) {
      if (static_cast<unsigned char>(c) < 0x20 || c == ':') return std::nullopt;
    }
    if (!result.empty()) result += '/';
    result += part;
  }
  if (result.empty()) return std::nullopt;
  return result;
}

bool is_game_name(std::string_view name) {
  return !name.empty() && name != "." && name.find("..") == name.npos && name.find_first_of("/\\:") == name.npos;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower(c);
  return result;
}

bool ends_with_ignoring_case(std::string_view text, std::string_view ending) {
  if (ending.size() > text.size()) return false;
  return lower_case(text.substr(text.size() - ending.size())) == lower_case(ending);
}

}  // namespace fb::fs
