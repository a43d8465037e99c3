#include "render/scene/lamp_numbers.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "shared/scene_gpu.h"

namespace fb::render {

const std::vector<std::uint32_t>& LampNumbers::of(std::uint32_t instance_id, std::uint32_t count) {
  Owner& owner = owners_[std::uint64_t{of_same_[instance_id]++} << 32 | instance_id];
  owner.used = true;
  while (owner.numbers.size() > count) {
    free_.push_back(owner.numbers.back());
    owner.numbers.pop_back();
  }
  while (owner.numbers.size() < count) {
    if (!free_.empty()) {
      owner.numbers.push_back(free_.front());
      free_.pop_front();
    } else if (end_ < shared::kMostLamps) {
      owner.numbers.push_back(end_++);
    } else {
      break;
    }
  }
  return owner.numbers;
}

void LampNumbers::free_unused() {
  of_same_.clear();
  std::vector<std::uint32_t> freed;
  for (auto at = owners_.begin(); at != owners_.end();) {
    Owner& owner = at->second;
    if (!owner.used) freed.insert(freed.end(), owner.numbers.begin(), owner.numbers.end());
    at = std::exchange(owner.used, false) ? std::next(at) : owners_.erase(at);
  }
  std::sort(freed.begin(), freed.end());  // the map's order is not to be seen in pictures
  free_.insert(free_.end(), freed.begin(), freed.end());
}

}  // namespace fb::render
