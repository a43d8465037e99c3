// Processor time, for tests that say something costs next to nothing: a busy machine's clock does not count.
#pragma once

#include <ctime>

namespace fb {

// Of all threads of this process, since the stopwatch was made.
class ProcessorTime {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace fb
