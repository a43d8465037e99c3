// How an offline rendering parts its samples into iterations, of which each samples what those before it have taught.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace fb::lab {

using Schedule = std::vector<std::uint32_t>;  // samples a pixel of each iteration, one or more

constexpr std::uint32_t kMostScheduled = 1u << 20u;  // samples a pixel of all iterations

// "1,1,2,4", or "doubling:N": N iterations of 1, 1, 2, 4, ... samples, 2^(N-1) together (Müller 2017).
Result<Schedule> parse_schedule(std::string_view text);
std::string schedule_text(const Schedule& schedule);  // "1,1,2,4"
std::uint32_t samples_of(const Schedule& schedule);

}  // namespace fb::lab
