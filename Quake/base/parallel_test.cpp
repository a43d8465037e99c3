#include "base/parallel.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
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

TEST(Parallel, MeanwhileSomethingElseIsDoneHere) {
  std::atomic<int> calls{0}, done{0};
  std::set<std::thread::id> workers, here;
  std::mutex mutex;
  const auto work = [&](std::size_t) {
    // A piece ends once it has been seen in the middle: no clock decides.
    for (int i = 0; i < 5000 && calls < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::lock_guard lock(mutex);
    workers.insert(std::this_thread::get_id());
    ++done;
  };
  parallel_for(3, 1, work, [&] {
    here.insert(std::this_thread::get_id());
    ++calls;
  });
  EXPECT_EQ(done, 3);
  EXPECT_GE(calls, 2) << "called while a piece still waits for it";
  EXPECT_EQ(here, std::set{std::this_thread::get_id()});
  EXPECT_FALSE(workers.contains(std::this_thread::get_id()));
  EXPECT_THROW(parallel_for(
                   2, 1, [](std::size_t) { throw std::runtime_error("two"); }, [] {}),
               std::runtime_error);
  parallel_for(0, 1, work, [] { FAIL(); });
}

}  // namespace
}  // namespace fb
