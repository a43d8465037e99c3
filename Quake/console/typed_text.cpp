#include "console/typed_text.h"

#include <cstdint>
#include <utility>

namespace fb::con {
namespace {

// The letters of U+00C0 to U+017F without their accents.
constexpr std::string_view kLatin =
    "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTs"
    "aaaaaaaceeeeiiiidnooooo/ouuuuyty"
    "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlLlLlNnNnNnnNnOoOoOoOo"
    "RrRrRrSsSsSsSsTtTtTtUuUuUuUuUuUuWwYyYZzZzZzs";
constexpr std::uint32_t kFirstLatin = 0xc0;
static_assert(kLatin.size() == 0x180 - kFirstLatin);

constexpr std::pair<std::uint32_t, std::string_view> kOthers[] = {
    {0xa0, " "},    {0xab, "\""},   {0xad, ""},     {0xb4, "'"},    {0xbb, "\""},    {0xc6, "AE"},  {0xdf, "ss"},
    {0xe6, "ae"},   {0x152, "OE"},  {0x153, "oe"},  {0x2018, "'"},  {0x2019, "'"},   {0x201a, "'"}, {0x201b, "'"},
    {0x201c, "\""}, {0x201d, "\""}, {0x201e, "\""}, {0x201f, "\""}, {0x2026, "..."}, {0x202f, " "}, {0x2039, "'"},
    {0x203a, "'"},  {0x2212, "-"},  {0x3000, " "},  {0xfeff, ""}};

struct CodePoint {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
};

// The one at the text's start; code 0xfffd, one byte, where the text is malformed there.
CodePoint first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || bytes > text.size()) return {0xfffd, 1};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return {0xfffd, 1};
    code = code << 6u | (byte(i) & 0x3fu);
  }
  return {code, bytes};
}

std::string_view letters_of(std::uint32_t code) {
  for (const auto& [other, letters] : kOthers)
    if (other == code) return letters;
  if (code >= kFirstLatin && code - kFirstLatin < kLatin.size()) return kLatin.substr(code - kFirstLatin, 1);
  if (code >= 0x300 && code < 0x370) return "";  // an accent of its own, behind its letter
  if (code >= 0x2000 && code <= 0x200a) return " ";
  if (code >= 0x200b && code <= 0x200f) return "";
  if (code >= 0x2010 && code <= 0x2015) return "-";
  return "?";
}

}  // namespace

std::string typed_text(std::string_view utf8) {
  std::string text;
  while (!utf8.empty()) {
    const CodePoint point = first_of(utf8);
    utf8.remove_prefix(point.bytes);
    const char c = static_cast<char>(point.code & 0x7fu);
    if (point.code >= 0x80)
      text += letters_of(point.code);
    else if (c == '\t')
      text += ' ';
    else if ((c >= ' ' && c != 0x7f) || c == '\n' || c == '\r')
      text += c;
  }
  return text;
}

}  // namespace fb::con
