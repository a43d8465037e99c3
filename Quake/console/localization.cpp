#include "console/localization.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

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

// --- letters ---

// From U+00A1, U+00C0 and U+0100 on, the plain letters.
constexpr std::string_view kLatinSigns = "!cL*Y|S\"ca<--R-o+23'uP.,1o>????";
constexpr std::string_view kLatin1 = "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty";
constexpr std::string_view kLatinExtended =
    "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlLlLlNnNnNnnNnOoOoOoOoRrRrRrSsSsSsSsTtTtTtUuUuUuUuUu"
    "UuWwYyYZzZzZzs";
static_assert(kLatin1.size() == 0x40 && kLatinExtended.size() == 0x80 && kLatinSigns.size() == 0x1f);

constexpr std::array<std::pair<std::uint32_t, std::string_view>, 22> kOthers = {{
    {0xa0, " "},    {0xab, "\""},    {0xbb, "\""},   {0xc6, "AE"},  {0xdf, "ss"},   {0xe6, "ae"},
    {0x132, "IJ"},  {0x133, "ij"},   {0x152, "OE"},  {0x153, "oe"}, {0x2010, "-"},  {0x2013, "-"},
    {0x2014, "-"},  {0x2018, "'"},   {0x2019, "'"},  {0x201a, ","}, {0x201c, "\""}, {0x201d, "\""},
    {0x201e, "\""}, {0x2026, "..."}, {0x2122, "TM"}, {0xfeff, ""},
}};

std::string_view letters_of(std::uint32_t code) {
  for (const auto& [other, letters] : kOthers)
    if (other == code) return letters;
  if (code >= 0xa1 && code < 0xc0) return kLatinSigns.substr(code - 0xa1, 1);
  if (code >= 0xc0 && code < 0x100) return kLatin1.substr(code - 0xc0, 1);
  if (code >= 0x100 && code < 0x180) return kLatinExtended.substr(code - 0x100, 1);
  return "?";
}

// The code that begins at `at`, which is moved behind it; nullopt where there is none.
std::optional<std::uint32_t> next_code(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(at);
  const std::size_t length = first >= 0xf0 && first < 0xf8 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
  if (length == 0 || first >= 0xf8 || length > text.size() - at) return std::nullopt;
  std::uint32_t code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0u) != 0x80u) return std::nullopt;
    code = code << 6u | (byte(at + i) & 0x3fu);
  }
  at += length;
  return code;
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

std::string quake_letters(std::string_view utf8) {
  std::string letters;
  for (std::size_t at = 0; at < utf8.size();) {
    if (static_cast<std::uint8_t>(utf8[at]) < 0x80) {
      letters.push_back(utf8[at++]);
    } else if (const auto code = next_code(utf8, at)) {
      letters += letters_of(*code);
    } else {
      letters.push_back(utf8[at++]);
    }
  }
  return letters;
}

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
