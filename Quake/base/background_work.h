// Independent pieces of work on threads of their own, which whoever waits for them may leave.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <semaphore>
#include <thread>
#include <vector>

namespace fb {

class BackgroundWork {
 public:
  // Calls work(i) for every i below `count`, each once, the lower ones earlier, on all processors. What pieces write
  // must not overlap; what `work` refers to must outlive this object.
  BackgroundWork(std::size_t count, std::function<void(std::size_t)> work);
  // Pieces that have not begun never do; those under way are waited for.
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  // Whether all threads have ended within this time. Then what a piece threw is thrown; pieces that had not begun by
  // then never do.
  bool wait_for(std::chrono::milliseconds time);
  // Pieces that have not begun never do. Waits for nothing.
  void give_up() { next_ = count_; }

 private:
  void take(std::size_t thread);

  const std::size_t count_;
  const std::function<void(std::size_t)> work_;
  std::atomic<std::size_t> next_{0};
  std::counting_semaphore<> ended_{0};
  std::vector<std::exception_ptr> failures_;  // one a thread
  std::vector<std::jthread> threads_;
  std::size_t running_ = 0;
};

}  // namespace fb
