// Probes of DDGI on the device, of a technique that asks them: their arrays, a frame's constants, and the passes that
// teach those which have a turn. Layouts: Shaders/estimators/ddgi/.
#pragma once

#include <cstdint>

#include "estimators/ddgi/ddgi.h"
#include "render/techniques/probe_grid.h"
#include "render/techniques/probe_table.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique.h"
#include "render/techniques/technique_memory.h"

namespace fb::render {

class Probes {
 public:
  // `plus`: they know all light that falls on a point (Majercik 2022, Eq. 5), else what is reflected to it (Eq. 4).
  Probes(const TechniqueTools& tools, bool plus);
  // Begins a frame, and `seen`'s. What it returns begins the technique's uniform block.
  shared::DdgiConstants prepare(const TechniqueFrame& frame, SeenGrid& seen);
  // Before the paths' pass.
  void add_passes(const TechniquePasses& passes);
  void forget() { memory_.forget(); }
  std::uint32_t frame() const { return frame_; }  // since it forgot
  std::uint64_t bytes() const { return memory_.bytes() + table_.bytes(); }

 private:
  TechniqueMemory memory_;
  ProbeTable table_;
  bool plus_;
  ProbeGrid grid_;
  std::uint32_t turns_ = 0, rays_ = 0;
  std::uint32_t frame_ = 0;
  bool fresh_ = false;  // all is zeroed in this frame
};

}  // namespace fb::render
