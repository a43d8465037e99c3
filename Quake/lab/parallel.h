// Rows of a picture on all processors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace fb::lab {

// Calls work(row) for every row below `rows`, each once, in no order. What rows write must not overlap. What one throws
// is thrown when all have ended.
template <typename Work>
void parallel_rows(std::uint32_t rows, const Work& work) {
  const std::uint32_t threads = std::clamp(std::thread::hardware_concurrency(), 1u, std::max(rows / 16, 1u));
  std::vector<std::exception_ptr> failures(threads);
  const auto stripe = [&](std::uint32_t t) {
    try {
      for (std::uint32_t row = t; row < rows; row += threads) work(row);
    } catch (...) {
      failures[t] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::uint32_t t = 1; t < threads; ++t) helpers.emplace_back(stripe, t);
    stripe(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace fb::lab
