#include "console/quake_letters.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace fb::con {
namespace {

// From U+00A1, U+00C0 and U+0100 on, the plain letters and signs.
constexpr std::string_view kSigns = "!cL*Y|S\"ca<--R-o+23'uP.,1o>????";
constexpr std::string_view kLatin =
    "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTs"
    "aaaaaaaceeeeiiiidnooooo/ouuuuyty"
    "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlLlLlNnNnNnnNnOoOoOoOo"
    "RrRrRrSsSsSsSsTtTtTtUuUuUuUuUuUuWwYyYZzZzZzs";
constexpr std::uint32_t kFirstSign = 0xa1, kFirstLatin = 0xc0;
static_assert(kSigns.size() == kFirstLatin - kFirstSign && kLatin.size() == 0x180 - kFirstLatin);

constexpr std::pair<std::uint32_t, std::string_view> kOthers[] = {
    {0xa0, " "},   {0xab, "\""},  {0xad, ""},     {0xb4, "'"},    {0xbb, "\""},   {0xc6, "AE"},   {0xdf, "ss"},
    {0xe6, "ae"},  {0x132, "IJ"}, {0x133, "ij"},  {0x152, "OE"},  {0x153, "oe"},  {0x2018, "'"},  {0x2019, "'"},
    {0x201a, "'"}, {0x201b, "'"}, {0x201c, "\""}, {0x201d, "\""}, {0x201e, "\""}, {0x201f, "\""}, {0x2026, "..."},
    {0x202f, " "}, {0x2039, "'"}, {0x203a, "'"},  {0x2122, "TM"}, {0x2212, "-"},  {0x3000, " "},  {0xfeff, ""}};

std::string_view letters_of(std::uint32_t code) {
  for (const auto& [other, letters] : kOthers)
    if (other == code) return letters;
  if (code >= kFirstSign && code < kFirstLatin) return kSigns.substr(code - kFirstSign, 1);
  if (code >= kFirstLatin && code - kFirstLatin < kLatin.size()) return kLatin.substr(code - kFirstLatin, 1);
  if (code >= 0x300 && code < 0x370) return "";  // an accent of its own, behind its letter
  if (code >= 0x2000 && code <= 0x200a) return " ";
  if (code >= 0x200b && code <= 0x200f) return "";
  if (code >= 0x2010 && code <= 0x2015) return "-";
  return "?";
}

// The code that begins at `at`, a byte of 0x80 or more, which is moved behind it; nullopt where there is none.
std::optional<std::uint32_t> next_code(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(at);
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || bytes > text.size() - at) return std::nullopt;
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xc0u) != 0x80u) return std::nullopt;
    code = code << 6u | (byte(at + i) & 0x3fu);
  }
  at += bytes;
  return code;
}

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

}  // namespace

std::string quake_letters(std::string_view utf8) {
  std::string letters;
  for (std::size_t at = 0; at < utf8.size();) {
    if (is_ascii(utf8[at]))
      letters += utf8[at++];
    else if (const auto code = next_code(utf8, at))
      letters += letters_of(*code);
    else
      letters += utf8[at++];
  }
  return letters;
}

std::string typed_text(std::string_view utf8) {
  std::string text;
  for (std::size_t at = 0; at < utf8.size();) {
    const char c = utf8[at];
    if (!is_ascii(c)) {
      const auto code = next_code(utf8, at);
      text += code ? letters_of(*code) : "?";
      if (!code) ++at;
      continue;
    }
    if (c == '\t')
      text += ' ';
    else if ((c >= ' ' && c != 0x7f) || c == '\n' || c == '\r')
      text += c;
    ++at;
  }
  return text;
}

}  // namespace fb::con
