// Independent pieces of work on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace fb {

// Calls work(i) for every i below `count`, each once, the lower ones earlier; this thread takes part. `least`: pieces
// that are worth a thread. What pieces write must not overlap. What one throws is thrown when all threads have ended;
// pieces that had not begun by then never do. background_work.h has what does not hold this thread.
template <typename Work>
void parallel_for(std::size_t count, std::size_t least, const Work& work) {
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
    std::vector<std::jthread> helpers;
    for (std::size_t thread = 1; thread < threads; ++thread) helpers.emplace_back(take, thread);
    take(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace fb
