#include "base/background_work.h"

#include <algorithm>
#include <utility>

namespace fb {

BackgroundWork::BackgroundWork(std::size_t count, std::function<void(std::size_t)> work)
    : count_(count), work_(std::move(work)) {
  running_ = std::min<std::size_t>(count, std::max(std::thread::hardware_concurrency(), 1u));
  failures_.resize(running_);
  for (std::size_t thread = 0; thread < running_; ++thread)
    threads_.emplace_back([this, thread] {
      take(thread);
      ended_.release();
    });
}

BackgroundWork::~BackgroundWork() {
  give_up();
  threads_.clear();  // joins
}

void BackgroundWork::take(std::size_t thread) {
  try {
    for (std::size_t i = next_++; i < count_; i = next_++) work_(i);
  } catch (...) {
    failures_[thread] = std::current_exception();
    give_up();
  }
}

bool BackgroundWork::wait_for(std::chrono::milliseconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  for (; running_ > 0; --running_)
    if (!ended_.try_acquire_until(until)) return false;
  for (const std::exception_ptr& failure : failures_)
    if (failure) std::rethrow_exception(failure);
  return true;
}

}  // namespace fb
