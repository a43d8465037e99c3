#include "lab/iterate/schedule.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <numeric>

#include "base/number.h"

namespace fb::lab {
namespace {

constexpr std::string_view kDoubling = "doubling:";
constexpr std::uint32_t kMostIterations = std::bit_width(kMostScheduled);

}  // namespace

Result<Schedule> parse_schedule(std::string_view text) {
  const Error malformed{fmt::format(
      "--schedule {}: samples a pixel of each iteration are wanted, as 1,1,2,4, or doubling:N with N from 1 to {}",
      text, kMostIterations)};
  if (text.starts_with(kDoubling)) {
    const auto count = parse_whole_number_unsigned(text.substr(kDoubling.size()));
    if (!count || *count < 1 || *count > kMostIterations) return malformed;
    Schedule schedule{1};
    for (std::uint32_t i = 1; i < *count; ++i) schedule.push_back(1u << (i - 1));
    return schedule;
  }
  Schedule schedule;
  std::uint64_t sum = 0;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const auto samples = parse_whole_number_unsigned(rest.substr(0, comma));
    if (!samples || *samples < 1) return malformed;
    if (*samples > kMostScheduled || (sum += *samples) > kMostScheduled)
      return Error{fmt::format("--schedule {}: it has more than {} samples a pixel", text, kMostScheduled)};
    schedule.push_back(static_cast<std::uint32_t>(*samples));
    if (comma == rest.npos) return schedule;
    rest.remove_prefix(comma + 1);
  }
}

Schedule schedule_of(std::uint32_t samples) {
  constexpr std::size_t kEven = 4;
  Schedule schedule;
  for (std::uint32_t next = 2; samples > 0; next *= schedule.size() >= kEven ? 2 : 1) {
    schedule.push_back(samples < 2 * next ? samples : next);
    samples -= schedule.back();
  }
  return schedule;
}

std::string schedule_text(const Schedule& schedule) { return fmt::format("{}", fmt::join(schedule, ",")); }

std::uint32_t samples_of(const Schedule& schedule) {
  return std::accumulate(schedule.begin(), schedule.end(), std::uint32_t{0});
}

}  // namespace fb::lab
