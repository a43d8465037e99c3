// LogBudget: while one lives, very many log lines are counted instead of written (base/log_flow.h). For programs that
// run for long, and whose lines come from mods and players; tools and tests write all of theirs.
#pragma once

#include "base/log_flow.h"

namespace fb {

class LogBudget {
 public:
  explicit LogBudget(const LogLimits& limits = {});
  ~LogBudget();  // says what is left to say
  LogBudget(const LogBudget&) = delete;
  LogBudget& operator=(const LogBudget&) = delete;
};

// Time of the program passes, seconds: the budget comes back.
void advance_log_time(double seconds);

}  // namespace fb
