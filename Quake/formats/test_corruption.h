// Ways of damaging a valid file that every parser must survive: truncated at each length, and with each byte and word
// replaced by values likely to overflow. For tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "base/bytes.h"

namespace fb::formats::testing {

// The result of parsing some bytes: an error message, or the first promise that the result breaks (empty if none).
struct Outcome {
  bool refused = false;
  std::string text;
};
using Attempt = std::function<Outcome(const Bytes&)>;

// Makes an Attempt from parse(bytes) -> Result<T> and promise(const T&) -> the broken promise.
template <typename Parse, typename Promise>
Attempt attempt(Parse parse, Promise promise) {
  return [parse, promise](const Bytes& bytes) -> Outcome {
    auto result = parse(bytes);
    if (!result.ok()) return {true, result.error().message};
    return {false, promise(*result)};
  };
}

// Checks that an error has the file's name, an offset that lies within it, and a cause.
inline ::testing::AssertionResult names_place(const std::string& message, const std::string& file, std::size_t size) {
  const std::string start = file + ": offset ";
  if (!message.starts_with(start)) return ::testing::AssertionFailure() << "names no offset: " << message;
  std::size_t digits = 0;
  const std::size_t offset = std::stoull(message.substr(start.size()), &digits);
  if (offset > size) return ::testing::AssertionFailure() << "offset beyond the file: " << message;
  if (message.size() < start.size() + digits + 10) return ::testing::AssertionFailure() << "no cause: " << message;
  return ::testing::AssertionSuccess();
}

inline void expect_refused(const Attempt& attempt, const Bytes& bytes, const std::string& file) {
  const Outcome outcome = attempt(bytes);
  ASSERT_TRUE(outcome.refused) << file << " of " << bytes.size() << " bytes was taken";
  ASSERT_TRUE(names_place(outcome.text, file, bytes.size()));
}

inline void expect_refused_when_cut(const Attempt& attempt, const Bytes& valid, const std::string& file) {
  ASSERT_EQ(attempt(valid).text, "");
  for (std::size_t length = 0; length < valid.size(); ++length) {
    expect_refused(attempt, Bytes(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(length)), file);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

// Checks that a file is either refused with an offset, or accepted with every promise kept.
inline void expect_sound_when_damaged(const Attempt& attempt, const Bytes& valid, const std::string& file) {
  const auto check = [&](const Bytes& damaged, std::size_t at) {
    const Outcome outcome = attempt(damaged);
    if (outcome.refused)
      ASSERT_TRUE(names_place(outcome.text, file, damaged.size())) << "byte " << at;
    else
      ASSERT_EQ(outcome.text, "") << "byte " << at;
  };
  constexpr std::array<std::uint8_t, 5> kBytes = {0x00, 0x01, 0x7f, 0x80, 0xff};
  constexpr std::array<std::uint32_t, 6> kWords = {0xffffffffu, 0x7fffffffu, 0x80000000u,
                                                   0x10000001u, 0x7fc00000u, 0x7f800000u};
  for (std::size_t at = 0; at < valid.size(); ++at) {
    Bytes damaged = valid;
    for (const std::uint8_t value : kBytes) {
      damaged[at] = value;
      check(damaged, at);
      if (::testing::Test::HasFatalFailure()) return;
    }
    if (at + 4 > valid.size()) continue;
    for (const std::uint32_t value : kWords) {
      for (std::size_t i = 0; i < 4; ++i) damaged[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
      check(damaged, at);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace fb::formats::testing
