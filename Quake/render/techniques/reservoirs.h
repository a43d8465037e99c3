// Reservoirs of light of every pixel, over frames and neighbours, of a technique that reuses. Layouts:
// Shaders/estimators/restir/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "estimators/restir/restir.h"
#include "render/techniques/technique.h"
#include "render/techniques/technique_memory.h"
#include "shared/frame.h"

namespace fb::render {

using ShiningSuns = std::array<vec3, shared::kMaxSuns>;

class Reservoirs {
 public:
  // `indirect`: light of two reflections is reused, too.
  Reservoirs(const TechniqueTools& tools, bool indirect);
  // Of a technique's uniform block, with these.
  static constexpr std::size_t kBlockBytes = shared::kRestirConstantsAt + sizeof(shared::RestirConstants);
  // Begins a frame, and fills its constants in `block`. `seen_ways`: SeenGrid::begin_frame.
  void prepare(const TechniqueFrame& frame, std::uint32_t seen_ways, std::byte* block);
  // Before the paths' pass, and after it.
  void add_before(const TechniquePasses& passes);
  void add_after(const TechniquePasses& passes);
  void forget() { memory_.forget(); }
  std::uint64_t bytes() const { return memory_.bytes(); }

 private:
  // Of squares of 8x8 pixels.
  static void add_boiling(const TechniquePasses& passes, const char* name, const char* shader);

  TechniqueMemory memory_;
  bool indirect_, spatial_ = true, boiling_ = false;
  bool wrote_indirect_ = false, keeps_radiance_ = false;  // in the frame before
  ShiningSuns suns_{};                                    // in the frame before
};

}  // namespace fb::render
