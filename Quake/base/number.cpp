#include "base/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

namespace fb {
namespace {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

template <typename T>
std::optional<T> parse_whole(std::string_view text) {
  text = without_blanks(text);
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <typename T>
Error whole_wanted(std::string_view what, std::string_view text, T low, T high) {
  return Error{fmt::format("{} {}: a whole number from {} to {} is wanted", what, text, low, high)};
}

}  // namespace

// Uses strtod, so that a number read here has the same value as where C's atof reads it.
std::optional<double> parse_number(std::string_view text) {
  const std::string copy(without_blanks(text));
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (copy.empty() || end != copy.c_str() + copy.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_whole_number(std::string_view text) { return parse_whole<std::int64_t>(text); }
std::optional<std::uint64_t> parse_whole_number_unsigned(std::string_view text) {
  return parse_whole<std::uint64_t>(text);
}

Result<double> number_of(std::string_view what, std::string_view text) {
  if (const auto value = parse_number(text)) return *value;
  return Error{fmt::format("{} {}: a number is wanted", what, text)};
}

Result<double> number_in(std::string_view what, std::string_view text, double low, double high) {
  const auto value = parse_number(text);
  if (value && *value >= low && *value <= high) return *value;
  return Error{fmt::format("{} {}: a number from {} to {} is wanted", what, text, low, high)};
}

Error whole_number_wanted(std::string_view what, std::string_view text, std::int64_t low, std::int64_t high) {
  return whole_wanted(what, text, low, high);
}
Error whole_number_wanted(std::string_view what, std::string_view text, std::uint64_t low, std::uint64_t high) {
  return whole_wanted(what, text, low, high);
}

}  // namespace fb
