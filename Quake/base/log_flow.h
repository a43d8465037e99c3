// LogFlow: which of very many lines are worth writing. A mod that prints in every frame, or a client that makes the
// server speak, would fill a disk and hide what else is said. So a line that comes over and over is counted after a
// while, and beyond a budget of lines lines are counted; how many is said as soon as something else is, or a second
// later. Errors have a budget of their own, so that no chatter hides one, and an error that comes without end, because
// a mod tries each frame what cannot be, fills no disk either.
//
// Time is what the program says it is (advance): a server that simulates an hour in a minute may say as much as in an
// hour.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fb {

struct LogLimits {
  // Lines that may come at once, and of these how many come back in a second. The longest list that a command prints
  // (all entities of a level) is far below the first. A long line counts as several of kLineBytes.
  double burst = 100000.0, lines_a_second = 200.0;
  std::uint64_t same_in_a_row = 100;
  static constexpr double kLineBytes = 256.0;
};

class LogFlow {
 public:
  explicit LogFlow(const LogLimits& limits) : limits_(limits), budget_(limits.burst), error_budget_(limits.burst) {}

  struct Answer {
    bool written = true;
    std::string first;  // a sentence to be written before it; empty: none
  };
  Answer take(std::string_view line, bool is_error);
  // Time passes. The sentence that is due; empty: none.
  std::string advance(double seconds);
  // What has not been said yet; empty: nothing.
  std::string rest();

 private:
  LogLimits limits_;
  double budget_, error_budget_, unsaid_seconds_ = 0.0;
  std::string last_;  // that was written
  std::uint64_t same_ = 0, repeats_ = 0, left_out_ = 0;
};

}  // namespace fb
