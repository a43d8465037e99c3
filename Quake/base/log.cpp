#include "base/log.h"

#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "base/log_budget.h"

namespace fb {
namespace {
struct Sinks {
  std::mutex mutex;
  std::map<int, std::function<void(LogLevel, std::string_view)>> listeners;
  int next_handle = 1;
  LogLevel level = LogLevel::kInfo;
  std::optional<LogFlow> flow;
};
Sinks& sinks() {
  static Sinks instance;
  return instance;
}

void write_line(LogLevel level, std::string_view text) {
  Sinks& s = sinks();
  std::map<int, std::function<void(LogLevel, std::string_view)>> listeners;
  {
    std::lock_guard lock(s.mutex);
    std::FILE* stream = level >= LogLevel::kWarning ? stderr : stdout;
    const char* prefix = level == LogLevel::kWarning ? "warning: " : level == LogLevel::kError ? "error: " : "";
    std::fprintf(stream, "%s%.*s\n", prefix, static_cast<int>(text.size()), text.data());
    std::fflush(stream);
    listeners = s.listeners;  // called without the lock: a listener may log
  }
  for (auto& [handle, listener] : listeners) listener(level, text);
}
}  // namespace

void log_line(LogLevel level, std::string_view text) {
  Sinks& s = sinks();
  LogFlow::Answer answer;
  {
    std::lock_guard lock(s.mutex);
    if (level < s.level) return;
    if (s.flow) answer = s.flow->take(text, level == LogLevel::kError);
  }
  if (!answer.first.empty()) write_line(LogLevel::kInfo, answer.first);
  if (answer.written) write_line(level, text);
}

LogBudget::LogBudget(const LogLimits& limits) {
  std::lock_guard lock(sinks().mutex);
  sinks().flow.emplace(limits);
}

LogBudget::~LogBudget() {
  std::string rest;
  {
    std::lock_guard lock(sinks().mutex);
    if (sinks().flow) rest = sinks().flow->rest();
    sinks().flow.reset();
  }
  if (!rest.empty()) write_line(LogLevel::kInfo, rest);
}

void advance_log_time(double seconds) {
  std::string due;
  {
    std::lock_guard lock(sinks().mutex);
    if (sinks().flow) due = sinks().flow->advance(seconds);
  }
  if (!due.empty()) write_line(LogLevel::kInfo, due);
}

int add_log_listener(std::function<void(LogLevel, std::string_view)> listener) {
  std::lock_guard lock(sinks().mutex);
  sinks().listeners.emplace(sinks().next_handle, std::move(listener));
  return sinks().next_handle++;
}

void remove_log_listener(int handle) {
  std::lock_guard lock(sinks().mutex);
  sinks().listeners.erase(handle);
}

void set_log_level(LogLevel level) {
  std::lock_guard lock(sinks().mutex);
  sinks().level = level;
}

}  // namespace fb
