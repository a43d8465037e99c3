// The table of DDGI's probes (kDdgiTable of Shaders/estimators/ddgi/ddgi.h) that the host keeps: where each stands, and
// which leafs of the map may ask it. A probe's part changes only when its cell does, doors when one moves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/maths.h"
#include "estimators/ddgi/ddgi.h"
#include "gpu/buffer.h"
#include "render/passes/pass.h"
#include "render/techniques/probe_doors.h"
#include "render/techniques/probe_grid.h"
#include "render/techniques/probe_leaves.h"
#include "scene/snapshot.h"

namespace fb::render {

class ProbeTable {
 public:
  explicit ProbeTable(gpu::Device& device) : device_(device) {}

  // Once a frame, between submissions. Not `wanted`, and for a scene that has neither leafs nor doors: there is no
  // table, and probes stand in the grid. True: probes stand otherwise than before, and must forget. Throws OutOfMemory.
  bool prepare(const scene::FrameSnapshot& snapshot, const ProbeGrid& grid, bool wanted);
  std::uint64_t elements() const { return elements_; }  // of kDdgiTable, at least one
  std::uint32_t standing() const { return standing_; }  // probes that have a place
  void fill(shared::DdgiConstants& constants) const;
  // Copies what has changed, or `all`, before the passes that read it.
  void add_upload(PassList& list, const gpu::Buffer& table, bool all);
  std::uint64_t bytes() const { return staging_.size(); }  // on the host's side of the device, besides the table

 private:
  struct Range {
    std::uint64_t begin = ~std::uint64_t{0}, end = 0;  // bytes
    void add(std::uint64_t from, std::uint64_t to) {
      begin = std::min(begin, from);
      end = std::max(end, to);
    }
  };
  void lay_out();
  void stand();  // probes whose cells are new
  void place(std::uint32_t probe, const glm::ivec3& cell);
  Bounds around(std::uint32_t probe) const;  // of all points that ask it
  void write_row(std::uint32_t probe);
  void write_starts();
  void write_doors(const std::vector<Bounds>& changed);
  std::uint32_t* words(std::uint64_t element) { return static_cast<std::uint32_t*>(staging_.mapped()) + 4 * element; }

  gpu::Device& device_;
  std::shared_ptr<const formats::Bsp> map_;
  std::unique_ptr<LeafGraph> graph_;
  ProbeDoors finder_;
  std::vector<Bounds> doors_;
  ProbeGrid grid_;
  bool on_ = false;
  std::vector<glm::ivec3> cells_;  // of each probe
  std::vector<vec3> places_;
  std::vector<std::uint8_t> stands_;  // whether it has a place
  std::uint32_t standing_ = 0, steps_ = 0;
  std::uint64_t elements_ = 1, door_elements_ = 0, node_elements_ = 0, start_elements_ = 0, row_elements_ = 0;
  gpu::Buffer staging_;
  Range head_, rows_;  // that have changed
};

}  // namespace fb::render
