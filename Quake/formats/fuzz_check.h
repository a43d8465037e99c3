// What every fuzz target of this module demands: bytes are refused with a place and a cause, or taken with every
// promise of the headers kept.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/result.h"

namespace fb::formats::testing {

inline constexpr const char* kFuzzName = "fuzzed";

inline void demand(bool condition, const std::string& complaint) {
  if (condition) return;
  std::fprintf(stderr, "promise broken: %s\n", complaint.c_str());
  std::abort();
}

template <typename T>
void demand_place(const Result<T>& refused) {
  demand(refused.error().message.starts_with("fuzzed: offset "), "error without a place: " + refused.error().message);
}

// `promise(value)` names what is broken, or is empty.
template <typename T, typename Promise>
void demand_sound(const Result<T>& result, const Promise& promise) {
  if (result.ok())
    demand(promise(*result).empty(), promise(*result));
  else
    demand_place(result);
}

}  // namespace fb::formats::testing
