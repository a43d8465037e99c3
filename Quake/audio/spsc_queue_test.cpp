// The queue between two threads: order, fullness, and that nothing is lost or read half-written under stress.
#include "audio/spsc_queue.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <thread>

namespace fb::audio {
namespace {

TEST(SpscQueue, KeepsOrderAndSaysWhenItIsFull) {
  SpscQueue<int> queue(3);
  ASSERT_EQ(queue.capacity(), 4u);
  int out = 0;
  EXPECT_FALSE(queue.pop(out));
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(i));
    int more = 99;
    EXPECT_FALSE(queue.push(more));
    EXPECT_EQ(queue.room(), 0u);
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(queue.pop(out));
      EXPECT_EQ(out, i);
    }
    EXPECT_FALSE(queue.pop(out));
  }
}

TEST(SpscQueue, WhatFindsNoRoomIsNotMovedFrom) {
  SpscQueue<std::unique_ptr<int>> queue(2);
  auto a = std::make_unique<int>(1), b = std::make_unique<int>(2), c = std::make_unique<int>(3);
  EXPECT_TRUE(queue.push(a) && queue.push(b));
  EXPECT_FALSE(queue.push(c));
  ASSERT_TRUE(c);
  EXPECT_EQ(*c, 3);
}

TEST(SpscQueue, SpansWrapAround) {
  SpscQueue<float> queue(8);
  std::vector<float> in(5), out(5);
  float next = 0.0f, expected = 0.0f;
  for (int round = 0; round < 20; ++round) {
    std::iota(in.begin(), in.end(), next);
    next += static_cast<float>(queue.push(std::span<const float>(in)));
    const std::size_t read = queue.pop(std::span(out));
    for (std::size_t i = 0; i < read; ++i) EXPECT_EQ(out[i], expected++);
  }
  EXPECT_EQ(next, expected);
  EXPECT_EQ(next, 100.0f);
}

// Each item is a pointer that counts its owners: one that is lost, doubled or torn shows.
TEST(SpscQueue, TwoThreads) {
  constexpr std::uint64_t kItems = 40000;
  struct Item {
    std::uint64_t number = 0, twice = 0;
    std::shared_ptr<std::uint64_t> shared;
  };
  SpscQueue<Item> queue(64);
  const auto shared = std::make_shared<std::uint64_t>(7);
  std::thread producer([&] {
    for (std::uint64_t i = 0; i < kItems; ++i) {
      Item item{i, 2 * i, shared};
      while (!queue.push(item)) std::this_thread::yield();
    }
  });
  Item item;
  for (std::uint64_t i = 0; i < kItems; ++i) {
    while (!queue.pop(item)) std::this_thread::yield();
    ASSERT_EQ(item.number, i);
    ASSERT_EQ(item.twice, 2 * i);
    ASSERT_EQ(*item.shared, 7u);
  }
  producer.join();
  EXPECT_FALSE(queue.pop(item));
  item = {};
  EXPECT_EQ(shared.use_count(), 1) << "the queue keeps nothing that was taken out";
}

TEST(SpscQueue, TwoThreadsWithSpans) {
  constexpr std::uint32_t kItems = 2000000;
  SpscQueue<std::uint32_t> queue(1000);
  std::thread producer([&] {
    std::vector<std::uint32_t> block(257);
    for (std::uint32_t next = 0; next < kItems;) {
      const std::size_t count = std::min<std::size_t>(block.size(), kItems - next);
      std::iota(block.begin(), block.end(), next);
      next += static_cast<std::uint32_t>(queue.push(std::span<const std::uint32_t>(block).first(count)));
    }
  });
  std::vector<std::uint32_t> block(301);
  for (std::uint32_t expected = 0; expected < kItems;) {
    const std::size_t read = queue.pop(std::span(block));
    for (std::size_t i = 0; i < read; ++i) ASSERT_EQ(block[i], expected++);
  }
  producer.join();
}

}  // namespace
}  // namespace fb::audio
