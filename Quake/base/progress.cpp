#include "base/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/system.h"

namespace fb {
namespace {

double machine_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Progress::Progress(std::string what, std::uint64_t total, ProgressOptions options)
    : what_(std::move(what)),
      total_(total),
      options_(std::move(options)),
      rewrites_(!options_.lines && is_terminal(options_.file)) {
  if (!options_.clock) options_.clock = machine_seconds;
  start_ = last_ = options_.clock();
}

Progress::~Progress() {
  if (shown_ && rewrites_) std::fputc('\n', options_.file);
}

void Progress::update(std::uint64_t done) {
  if (options_.quiet || total_ == 0) return;
  const double now = options_.clock();
  const double interval = rewrites_ ? kRewriteSeconds : kLineSeconds;
  if (now - last_ < interval && !(rewrites_ && shown_ && done == total_)) return;
  last_ = now;
  shown_ = true;
  done = std::min(done, total_);
  const double left = done > 0 ? (now - start_) / static_cast<double>(done) * static_cast<double>(total_ - done) : 0.0;
  fmt::print(options_.file, "{}{}: {} of {}, {:.0f} s left{}", rewrites_ ? "\r" : "", what_, done, total_, left,
             rewrites_ ? "   " : "\n");
  std::fflush(options_.file);
}

}  // namespace fb
