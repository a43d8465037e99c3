// For tests: collects what is logged while it lives.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/log.h"

namespace fb::fs {

class LogLines {
 public:
  LogLines() : handle_(add_log_listener([this](LogLevel, std::string_view line) { lines.emplace_back(line); })) {}
  ~LogLines() { remove_log_listener(handle_); }
  LogLines(const LogLines&) = delete;
  LogLines& operator=(const LogLines&) = delete;
  std::vector<std::string> lines;

 private:
  int handle_;
};

}  // namespace fb::fs
