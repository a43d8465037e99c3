// DeviceArray: a device buffer of items that grows and keeps its front. The front is appended to as assets arrive; what
// lies behind it is each frame's own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "gpu/commands.h"

namespace fb::render {

template <typename T>
class DeviceArray {
 public:
  DeviceArray(gpu::Device& device, gpu::BufferUse use, std::string name)
      : device_(device), use_(use), name_(std::move(name)) {}

  const gpu::Buffer& buffer() const { return buffer_; }
  std::uint64_t bytes() const { return buffer_ ? buffer_.size() : 0; }
  // Items that the device allows.
  std::uint64_t most() const { return gpu::largest_buffer(device_, use_) / 16 * 16 / sizeof(T); }
  // Items that stay from frame to frame.
  std::uint32_t kept() const { return kept_; }
  void clear() { kept_ = 0; }

  // Makes room for `items` in all; the kept ones survive. Between submissions.
  void reserve(std::uint64_t items) {
    // Whole texels of four words: a texel buffer sees no others.
    const std::uint64_t needed = std::max<std::uint64_t>((items * sizeof(T) + 15) / 16 * 16, 256);
    if (buffer_ && buffer_.size() >= needed) return;
    // The first size is taken at its word (a map's assets come at once), later ones get some slack, where there is
    // room.
    const std::uint64_t roomy =
        std::min(buffer_ ? needed + needed / 4 : needed, gpu::largest_buffer(device_, use_)) / 16 * 16;
    gpu::Buffer larger(device_, use_, std::max(needed, roomy), name_);
    if (kept_ > 0) {
      device_.run([&](gpu::Commands& commands) { commands.copy(buffer_, larger, std::uint64_t{kept_} * sizeof(T)); });
    }
    buffer_ = std::move(larger);
  }

  // Appends to the kept items; returns the first one's index.
  std::uint32_t append(std::span<const T> items) {
    std::uint32_t first = kept_;
    reserve(std::uint64_t{kept_} + items.size());
    if (!items.empty()) gpu::upload_now(device_, buffer_, items, std::uint64_t{first} * sizeof(T));
    kept_ += static_cast<std::uint32_t>(items.size());
    return first;
  }

 private:
  gpu::Device& device_;
  gpu::BufferUse use_;
  std::string name_;
  gpu::Buffer buffer_;
  std::uint32_t kept_ = 0;
};

}  // namespace fb::render
