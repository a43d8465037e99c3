#include "host/game/terminal.h"

#ifndef _WIN32
#include <poll.h>
#include <unistd.h>
#endif

#include <array>

namespace fb::host {

std::optional<std::string> TerminalLines::next() {
  constexpr std::size_t kLongestLine = 65536;
  std::size_t end = text_.find('\n');
  while (end == std::string::npos && text_.size() < kLongestLine && read_more()) end = text_.find('\n');
  if (end == std::string::npos) {
    if (!(ended_ || text_.size() >= kLongestLine) || text_.empty()) return std::nullopt;
    end = text_.size();  // the last line may have no newline
  }
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  return line;
}

bool TerminalLines::read_more() {
#ifdef _WIN32
  ended_ = true;
  return false;
#else
  if (ended_) return false;
  // A background job that reads what is typed for the shell would be stopped (SIGTTIN).
  const pid_t in_front = ::tcgetpgrp(file_);
  if (in_front > 0 && in_front != ::getpgrp()) return false;
  pollfd wanted{file_, POLLIN, 0};
  if (poll(&wanted, 1, 0) <= 0) return false;
  std::array<char, 4096> bytes{};
  const ssize_t count = read(file_, bytes.data(), bytes.size());
  if (count <= 0) {
    ended_ = true;
    return false;
  }
  text_.append(bytes.data(), static_cast<std::size_t>(count));
  return true;
#endif
}

}  // namespace fb::host
