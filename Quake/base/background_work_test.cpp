#include "base/background_work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <semaphore>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fb {
namespace {

using namespace std::chrono_literals;

// Long enough for any machine; no test waits for it to pass.
void wait_until_done(BackgroundWork& work) {
  while (!work.wait_for(1s)) {}
}

TEST(BackgroundWork, EveryPieceIsDoneOnceOnOtherThreads) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<std::atomic<int>> done(count);
    std::mutex mutex;
    std::set<std::thread::id> threads;
    BackgroundWork work(count, [&](std::size_t i) {
      ++done[i];
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
    wait_until_done(work);
    EXPECT_TRUE(work.wait_for(0ms)) << "asked again";
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1) << count;
    EXPECT_FALSE(threads.contains(std::this_thread::get_id()));
  }
}

TEST(BackgroundWork, WhoeverWaitsIsToldThatItIsNotDone) {
  std::binary_semaphore go(0);
  BackgroundWork work(1, [&](std::size_t) { go.acquire(); });
  EXPECT_FALSE(work.wait_for(0ms));
  EXPECT_FALSE(work.wait_for(1ms));
  go.release();
  wait_until_done(work);
}

TEST(BackgroundWork, WhatAPieceThrowsIsThrownAndTheRestLeftOut) {
  std::atomic<std::size_t> begun{0};
  constexpr std::size_t kMany = 1'000'000'000;  // more than another thread does while this one throws
  BackgroundWork work(kMany, [&](std::size_t i) {
    ++begun;
    if (i == 3) throw std::runtime_error("three");
  });
  EXPECT_THROW(wait_until_done(work), std::runtime_error);
  EXPECT_LT(begun, kMany);
}

TEST(BackgroundWork, WhatIsGivenUpEndsWithThePiecesUnderWay) {
  std::counting_semaphore<> begun(0), go(0);
  std::atomic<std::size_t> done{0};
  const std::size_t threads = std::max(std::thread::hardware_concurrency(), 1u);
  {
    BackgroundWork work(2 * threads, [&](std::size_t) {
      begun.release();
      go.acquire();
      ++done;
    });
    for (std::size_t i = 0; i < threads; ++i) begun.acquire();
    work.give_up();
    EXPECT_FALSE(work.wait_for(0ms));
    go.release(static_cast<std::ptrdiff_t>(threads));
  }
  EXPECT_EQ(done, threads);
}

}  // namespace
}  // namespace fb
