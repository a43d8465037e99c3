// LampNumbers: what lamps (shared/scene_gpu.h) are called from frame to frame. An instance's lamps keep their numbers
// while it is there; numbers of what is gone are given anew, the longest unused first, so that what is remembered of
// them has time to be forgotten.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

namespace fb::render {

class LampNumbers {
 public:
  // Numbers of `count` lamps of an instance; fewer where all are in use. The reference holds until the next call.
  const std::vector<std::uint32_t>& of(std::uint32_t instance_id, std::uint32_t count);
  // Those that were not asked for since the last call are free.
  void free_unused();
  std::uint32_t end() const {
    return end_;
  }  // above all that were ever given: memories may still name those of a former map

 private:
  struct Owner {
    std::vector<std::uint32_t> numbers;
    bool used = false;
  };
  std::unordered_map<std::uint64_t, Owner> owners_;           // by id and, above it, which of those that share it
  std::unordered_map<std::uint32_t, std::uint32_t> of_same_;  // asked for since the last free_unused, by id
  std::deque<std::uint32_t> free_;
  std::uint32_t end_ = 0;
};

}  // namespace fb::render
