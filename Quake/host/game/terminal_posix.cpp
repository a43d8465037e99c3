#include <poll.h>
#include <unistd.h>

#include <array>

#include "host/game/terminal.h"

namespace fb::host {

bool TerminalLines::read_more() {
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
}

}  // namespace fb::host
