#include "lab/progress.h"

#include <unistd.h>

#include <cstdio>

namespace fb::lab {

Progress::Progress(std::string what, std::uint64_t total, bool quiet)
    : what_(std::move(what)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (shown_ && terminal_) std::fputc('\n', stderr);
}

void Progress::update(std::uint64_t done) {
  if (quiet_ || total_ == 0) return;
  const auto now = Clock::now();
  const std::chrono::duration<double> since_last = now - last_, since_start = now - start_;
  const double interval = terminal_ ? 0.2 : 10.0;
  if (since_last.count() < interval && !(terminal_ && shown_ && done == total_)) return;
  last_ = now;
  shown_ = true;
  const double left =
      done > 0 ? since_start.count() / static_cast<double>(done) * static_cast<double>(total_ - done) : 0;
  std::fprintf(stderr, "%s%s: %llu of %llu, %.0f s left%s", terminal_ ? "\r" : "", what_.c_str(),
               static_cast<unsigned long long>(done), static_cast<unsigned long long>(total_), left,
               terminal_ ? "   " : "\n");
  std::fflush(stderr);
}

}  // namespace fb::lab
