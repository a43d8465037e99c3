#include "base/log_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace fb {

LogFlow::Answer LogFlow::take(std::string_view line, bool is_error) {
  if (line == last_) {
    if (++same_ > limits_.same_in_a_row) {
      ++repeats_;
      return {false, {}};
    }
  } else {
    same_ = 1;
  }
  const double cost = 1.0 + static_cast<double>(line.size()) / LogLimits::kLineBytes;
  double& budget = is_error ? error_budget_ : budget_;
  if (budget < cost) {
    ++left_out_;
    return {false, {}};
  }
  budget -= cost;
  Answer answer{true, line == last_ ? std::string() : rest()};
  last_ = line;
  return answer;
}

std::string LogFlow::advance(double seconds) {
  for (double* budget : {&budget_, &error_budget_})
    *budget = std::min(*budget + seconds * limits_.lines_a_second, limits_.burst);
  unsaid_seconds_ = repeats_ + left_out_ > 0 ? unsaid_seconds_ + seconds : 0.0;
  return unsaid_seconds_ < 1.0 ? std::string() : rest();
}

std::string LogFlow::rest() {
  unsaid_seconds_ = 0.0;
  std::string text;
  if (const std::uint64_t repeats = std::exchange(repeats_, 0); repeats > 0)
    text = fmt::format("(the same line {} more times)", repeats);
  if (const std::uint64_t left_out = std::exchange(left_out_, 0); left_out > 0)
    text += fmt::format("{}({} lines are left out: more than {} a second)", text.empty() ? "" : " ", left_out,
                        limits_.lines_a_second);
  return text;
}

}  // namespace fb
