// Independent pieces of work on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <semaphore>
#include <thread>
#include <vector>

namespace fb {

// Calls work(i) for every i below `count`, each once, the lower ones earlier; this thread takes part. `least`: pieces
// that are worth a thread. What pieces write must not overlap. What one throws is thrown when all threads have ended;
// pieces that had not begun by then never do. `meanwhile`, if there is one, is called on this thread some twenty times
// a second until all is done, in the place of taking part; it must not throw.
template <typename Work>
void parallel_for(std::size_t count, std::size_t least, const Work& work,
                  const std::function<void()>& meanwhile = nullptr) {
  const std::size_t processors = std::max(std::thread::hardware_concurrency(), 1u);
  const std::size_t threads = std::clamp<std::size_t>(count / std::max<std::size_t>(least, 1), 1, processors);
  std::vector<std::exception_ptr> failures(threads);
  std::atomic<std::size_t> next{0};
  const auto take = [&](std::size_t thread) {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      failures[thread] = std::current_exception();
      next = count;
    }
  };
  {
    std::counting_semaphore<> ended(0);
    std::vector<std::jthread> helpers;
    const auto help = [&](std::size_t thread) {
      take(thread);
      ended.release();
    };
    for (std::size_t thread = meanwhile ? 0 : 1; thread < threads; ++thread) helpers.emplace_back(help, thread);
    if (!meanwhile) take(0);
    for (std::size_t left = helpers.size(); meanwhile && left > 0;) {
      if (ended.try_acquire_for(std::chrono::milliseconds(50)))
        --left;
      else
        meanwhile();
    }
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace fb
