#include "render/scene/alias_table.h"

namespace fb::render {

// Weights times n are laid out over n places that hold `total` each. A place that is not full is filled up from one
// weight that has more than its place can hold.
std::vector<AliasPlace> make_alias_table(std::span<const std::uint32_t> weights, std::uint32_t total) {
  const auto n = static_cast<std::uint32_t>(weights.size());
  std::vector<AliasPlace> places(n);
  std::vector<std::uint64_t> left(n);
  std::vector<std::uint32_t> less, more;
  for (std::uint32_t i = 0; i < n; ++i) {
    left[i] = std::uint64_t{weights[i]} * n;
    (left[i] < total ? less : more).push_back(i);
    places[i] = {total, i};
  }
  while (!less.empty() && !more.empty()) {
    const std::uint32_t place = less.back(), rich = more.back();
    less.pop_back();
    places[place] = {static_cast<std::uint32_t>(left[place]), rich};
    left[rich] -= total - left[place];
    if (left[rich] < total) {
      more.pop_back();
      less.push_back(rich);
    }
  }
  return places;
}

}  // namespace fb::render
