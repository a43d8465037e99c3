// Rows of a picture on all processors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

namespace fb::lab {

// Calls work(row) for every row below `rows`, each once, in no order. What rows write must not overlap.
template <typename Work>
void parallel_rows(std::uint32_t rows, const Work& work) {
  const std::uint32_t threads = std::clamp(std::thread::hardware_concurrency(), 1u, std::max(rows / 16, 1u));
  const auto stripe = [&](std::uint32_t t) {
    for (std::uint32_t row = t; row < rows; row += threads) work(row);
  };
  std::vector<std::thread> helpers;
  for (std::uint32_t t = 1; t < threads; ++t) helpers.emplace_back(stripe, t);
  stripe(0);
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace fb::lab
