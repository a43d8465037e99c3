#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fb {
namespace {

TEST(Parallel, EveryPieceIsDoneOnce) {
  for (const std::size_t count : {0u, 1u, 2u, 3u, 1000u}) {
    std::vector<std::atomic<int>> done(count);
    parallel_for(count, 1, [&](std::size_t i) { ++done[i]; });
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1) << count;
  }
}

TEST(Parallel, FewPiecesStayOnThisThread) {
  std::set<std::thread::id> threads;
  parallel_for(15, 16, [&](std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(Parallel, WhatAPieceThrowsIsThrownAndTheRestLeftOut) {
  std::atomic<std::size_t> begun{0};
  const auto work = [&](std::size_t i) {
    ++begun;
    if (i == 3) throw std::runtime_error("three");
  };
  constexpr std::size_t kMany = 1'000'000'000;  // more than another thread does while this one throws
  EXPECT_THROW(parallel_for(kMany, 1, work), std::runtime_error);
  EXPECT_LT(begun, kMany);
}

}  // namespace
}  // namespace fb
