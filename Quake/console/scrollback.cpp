#include "console/scrollback.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace fb::con {
namespace {

std::size_t cost(const ScrollLine& line) { return line.text.size() + sizeof(ScrollLine); }

}  // namespace

Scrollback::Scrollback(std::size_t max_bytes) : max_bytes_(max_bytes) {}

void Scrollback::add(LogLevel level, std::string_view text) {
  std::lock_guard lock(mutex_);
  if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  std::size_t start = 0;
  while (true) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    add_line(level, text.substr(start, end - start));
    if (end == text.size()) break;
    start = end + 1;
  }
}

void Scrollback::add_line(LogLevel level, std::string_view text) {
  // A single line must not displace all others.
  lines_.push_back({std::string(text.substr(0, max_bytes_ / 4)), level, time_});
  bytes_ += cost(lines_.back());
  ++total_;
  while (bytes_ > max_bytes_ && lines_.size() > 1) {
    bytes_ -= cost(lines_.front());
    lines_.pop_front();
  }
}

void Scrollback::clear() {
  std::lock_guard lock(mutex_);
  lines_.clear();
  bytes_ = 0;
}

void Scrollback::set_max_bytes(std::size_t max_bytes) {
  std::lock_guard lock(mutex_);
  max_bytes_ = max_bytes;
}

void Scrollback::set_time(double seconds) {
  std::lock_guard lock(mutex_);
  time_ = seconds;
}

std::size_t Scrollback::size() const {
  std::lock_guard lock(mutex_);
  return lines_.size();
}

std::uint64_t Scrollback::total() const {
  std::lock_guard lock(mutex_);
  return total_;
}

std::vector<ScrollLine> Scrollback::latest(std::size_t count, std::size_t skip) const {
  std::lock_guard lock(mutex_);
  const std::size_t end = lines_.size() - std::min(skip, lines_.size());
  const std::size_t begin = end - std::min(count, end);
  return {std::next(lines_.begin(), static_cast<std::ptrdiff_t>(begin)),
          std::next(lines_.begin(), static_cast<std::ptrdiff_t>(end))};
}

std::vector<ScrollLine> Scrollback::recent(std::size_t count, double now, double max_age) const {
  std::vector<ScrollLine> lines = latest(count);
  const auto too_old = [&](const ScrollLine& line) { return now - line.time >= max_age; };
  lines.erase(std::remove_if(lines.begin(), lines.end(), too_old), lines.end());
  return lines;
}

}  // namespace fb::con
