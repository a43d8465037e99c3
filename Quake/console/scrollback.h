// The last megabyte of log lines (or as -consize says), for the console's window and for the notify lines over the
// game.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/log.h"

namespace fb::con {

struct ScrollLine {
  std::string text;
  LogLevel level = LogLevel::kInfo;
  double time = 0.0;  // seconds, of set_time()
};

// Safe to use from several threads, because any of them may log.
class Scrollback {
 public:
  explicit Scrollback(std::size_t max_bytes = 1u << 20u);
  // Adds one line, or several if the text has newlines.
  void add(LogLevel level, std::string_view text);
  void clear();
  // Limit on the kept text, from the next line on.
  void set_max_bytes(std::size_t max_bytes);
  // The time stamp of lines from now on, seconds.
  void set_time(double seconds);

  std::size_t size() const;  // lines kept
  // Number of lines ever added: changes whenever something is added.
  std::uint64_t total() const;
  // `count` lines that end `skip` lines before the newest, oldest first; fewer if there are no more.
  std::vector<ScrollLine> latest(std::size_t count, std::size_t skip = 0) const;
  // The newest lines that are younger than `max_age` seconds at `now`, at most `count`, oldest first.
  std::vector<ScrollLine> recent(std::size_t count, double now, double max_age) const;

 private:
  void add_line(LogLevel level, std::string_view text);

  mutable std::mutex mutex_;
  std::deque<ScrollLine> lines_;
  std::size_t max_bytes_, bytes_ = 0;
  std::uint64_t total_ = 0;
  double time_ = 0.0;
};

}  // namespace fb::con
