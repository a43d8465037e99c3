#include "console/localization.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "console/quake_letters.h"

namespace fb::con {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// What stands behind the "=": up to its closing quote, or all of it. With escapes undone.
std::string value_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('"')) text.remove_prefix(1);
  std::string value;
  for (std::size_t i = 0; i < text.size() && text[i] != '"'; ++i) {
    char c = text[i];
    if (c == '\\' && i + 1 < text.size()) {
      c = text[++i];
      constexpr std::string_view kNames = "ntvbf", kMeant = "\n\t\v\b\f";
      if (const std::size_t at = kNames.find(c); at != kNames.npos) c = kMeant[at];
    }
    if (c != '\0') value.push_back(c);
  }
  return value;
}

// --- placeholders ---

// The number of the placeholder that begins at `at`, which is moved behind it; nullopt where there is none.
std::optional<std::size_t> next_placeholder(std::string_view text, std::size_t& at) {
  if (text[at] != '{') return std::nullopt;
  std::size_t i = at + 1, number = 0;
  for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
    number = std::min<std::size_t>(10 * number + static_cast<std::size_t>(text[i] - '0'), 1000);
  if (i >= text.size() || text[i] != '}') return std::nullopt;
  at = i + 1;
  return number;
}

bool has_placeholders(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at)
    if (next_placeholder(text, at)) return true;
  return false;
}

}  // namespace

void Localization::add_line(std::string_view line, std::size_t& added) {
  line = trimmed(line);
  const std::size_t equals = line.find('=');
  if (line.starts_with('/') || equals == line.npos) return;
  std::string_view key = trimmed(line.substr(0, equals));
  if (key.size() >= 2 && key.starts_with('"') && key.ends_with('"')) key = key.substr(1, key.size() - 2);
  if (key.empty() || key.size() > kMostKeyBytes || texts_.contains(key)) return;
  texts_.emplace(key, quake_letters(value_of(line.substr(equals + 1))).substr(0, kMostTextBytes));
  ++added;
}

Result<std::size_t> Localization::add(ByteView file, std::string_view name) {
  if (file.size() > kMostFileBytes)
    return Error{fmt::format("{}: {} bytes of texts, of {} that are read", name, file.size(), kMostFileBytes)};
  std::string_view rest(reinterpret_cast<const char*>(file.data()), file.size());
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  std::size_t added = 0;
  while (!rest.empty()) {
    if (texts_.size() >= kMostTexts)
      return Error{fmt::format("{}: more than {} texts; the others are left out", name, kMostTexts)};
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    add_line(rest.substr(0, end), added);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return added;
}

std::string_view Localization::text(std::string_view given) const {
  if (!given.starts_with('$')) return given;
  const auto found = texts_.find(given.substr(1));
  return found == texts_.end() ? given : std::string_view(found->second);
}

std::string Localization::message(std::span<const std::string_view> pieces) const {
  std::string message;
  const auto add = [&](std::string_view piece) {
    message += piece.substr(0, kMostMessageBytes - std::min(message.size(), kMostMessageBytes));
  };
  if (pieces.empty()) return message;
  const std::string_view format = text(pieces.front());
  if (texts_.empty() || !has_placeholders(format)) {
    for (const std::string_view piece : pieces) add(text(piece));
    return message;
  }
  const auto others = pieces.subspan(1);
  for (std::size_t at = 0; at < format.size();) {
    if (const auto number = next_placeholder(format, at))
      add(*number < others.size() ? text(others[*number]) : std::string_view());
    else
      add(format.substr(at++, 1));
  }
  return message;
}

}  // namespace fb::con
