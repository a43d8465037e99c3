// Numbers that people type: options, arguments of console commands, settings. All are read here in the same way, and an
// invalid one gives the same kind of message: "-port abc: a whole number from 1 to 65535 is wanted".
//
// Numbers that Quake reads by C's atof, on which mods and configurations rely (values of cvars, commands that a mod
// stuffs, the text of entities), are read elsewhere: by con::Cvar::value, con::Args::number and progs/text_tokens.h.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "base/result.h"

namespace fb {

// Reads the whole text, apart from surrounding blanks, as a finite number; nullopt if it is none.
std::optional<double> parse_number(std::string_view text);
// The same for digits only, with an optional '-' before them.
std::optional<std::int64_t> parse_whole_number(std::string_view text);
std::optional<std::uint64_t> parse_whole_number_unsigned(std::string_view text);

// `what` is the option or command, for the message. Both limits are allowed values.
Result<double> number_of(std::string_view what, std::string_view text);
Result<double> number_in(std::string_view what, std::string_view text, double low, double high);

// The message alone, for callers that read several numbers from one text.
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
