// What is seen through the surfaces of liquids in maps whose visibility was compiled as if they were opaque: pairs of
// leafs on both sides of such a surface that do not see each other. Through it a viewer sees what the leaf on the other
// side sees; that is more than is in sight, as visibility always is. Of a map whose visibility lets liquids through
// there are none. Everything here is about the world (model 0).
#pragma once

#include <cstdint>
#include <vector>

#include "formats/bsp.h"
#include "world/pvs.h"

namespace fb::world {

class LiquidWindows {
 public:
  LiquidWindows() = default;
  explicit LiquidWindows(const formats::Bsp& bsp);

  bool empty() const { return windows_.empty(); }
  std::size_t count() const { return windows_.size(); }
  // Adds what `set` sees through liquids; of what it sees then, further surfaces count no more.
  void add(const formats::Bsp& bsp, LeafSet& set) const;

 private:
  struct Window {
    std::uint32_t near = 0, far = 0;  // leafs; a window is listed from both sides
    auto operator<=>(const Window&) const = default;
  };
  std::vector<Window> windows_;  // sorted, each once
};

}  // namespace fb::world
