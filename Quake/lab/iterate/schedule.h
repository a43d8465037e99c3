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
// What `still --guided` takes (Fan 2025): four iterations of 2 samples, then 4, 8, 16, ...; the last takes what does
// not fill another one. 24 samples are 2,2,2,2,4,12.
Schedule schedule_of(std::uint32_t samples);          // 1 to kMostScheduled
std::string schedule_text(const Schedule& schedule);  // "1,1,2,4"
std::uint32_t samples_of(const Schedule& schedule);

}  // namespace fb::lab
