// Numbers that people type: options, arguments of console commands, settings. There is one way to read them, and one
// kind of sentence where they are wrong: "-port abc: a whole number from 1 to 65535 is wanted".
//
// What Quake reads by C's atof, and mods and configurations lean on (the values of cvars, what a mod stuffs into the
// console, the text of entities), is not read here: con::Cvar::value, con::Args::number and progs/text_tokens.h do
// that.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "base/result.h"

namespace fb {

// The whole text as a finite number, blanks around it aside; nullopt where it is none.
std::optional<double> parse_number(std::string_view text);
// The same of digits alone, with a '-' before them where there is one.
std::optional<std::int64_t> parse_whole_number(std::string_view text);
std::optional<std::uint64_t> parse_whole_number_unsigned(std::string_view text);

// `what` is who wants the number: an option or a command. Both ends are allowed.
Result<double> number_of(std::string_view what, std::string_view text);
Result<double> number_in(std::string_view what, std::string_view text, double low, double high);

// The sentence alone, for those who look for several numbers in one text.
Error whole_number_wanted(std::string_view what, std::string_view text, std::int64_t low, std::int64_t high);
Error whole_number_wanted(std::string_view what, std::string_view text, std::uint64_t low, std::uint64_t high);

template <std::integral T>
Result<T> whole_number_in(std::string_view what, std::string_view text, T low = std::numeric_limits<T>::min(),
                          T high = std::numeric_limits<T>::max()) {
  if constexpr (std::signed_integral<T>) {
    const auto value = parse_whole_number(text);
    if (value && *value >= low && *value <= high) return static_cast<T>(*value);
    return whole_number_wanted(what, text, std::int64_t{low}, std::int64_t{high});
  } else {
    const auto value = parse_whole_number_unsigned(text);
    if (value && *value >= low && *value <= high) return static_cast<T>(*value);
    return whole_number_wanted(what, text, std::uint64_t{low}, std::uint64_t{high});
  }
}

}  // namespace fb
