// A lock-free queue of fixed size between two threads: one only pushes, the other only pops. Neither ever waits, which
// the device's thread must not. Head and tail count for ever; an item lies at its number modulo the size.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace fb::audio {

template <typename T>
class SpscQueue {
 public:
  // Rounded up to a power of two.
  explicit SpscQueue(std::size_t least) : items_(std::bit_ceil(std::max<std::size_t>(least, 2))) {}

  std::size_t capacity() const { return items_.size(); }

  // The pushing thread. `item` is moved from only if there is room.
  bool push(T& item) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == items_.size()) return false;
    items_[index(tail)] = std::move(item);
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  // As many as there is room for; returns their number.
  std::size_t push(std::span<const T> items) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t count = std::min(items.size(), items_.size() - (tail - head_.load(std::memory_order_acquire)));
    for (std::size_t i = 0; i < count; ++i) items_[index(tail + i)] = items[i];
    tail_.store(tail + count, std::memory_order_release);
    return count;
  }
  std::size_t room() const {
    return items_.size() - (tail_.load(std::memory_order_relaxed) - head_.load(std::memory_order_acquire));
  }

  // The popping thread.
  bool pop(T& item) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    item = std::move(items_[index(head)]);
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  // As many as there are; returns their number.
  std::size_t pop(std::span<T> items) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t count = std::min(items.size(), tail_.load(std::memory_order_acquire) - head);
    for (std::size_t i = 0; i < count; ++i) items[i] = std::move(items_[index(head + i)]);
    head_.store(head + count, std::memory_order_release);
    return count;
  }

 private:
  std::size_t index(std::size_t number) const { return number & (items_.size() - 1); }

  std::vector<T> items_;
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace fb::audio
