// Doors as probes of DDGI know them: boxes of a scene that move or may move, fill their bounds and let no light
// through. A probe is not asked through one: what lies behind a door that has closed is told by how it stands now, not
// by what a probe has learnt since.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/maths.h"
#include "scene/snapshot.h"

namespace fb::render {

class ProbeDoors {
 public:
  // Of a frame, those that meet `within`, in the order of its instances, at most `most`.
  std::vector<Bounds> find(const scene::FrameSnapshot& snapshot, const Bounds& within, std::size_t most);

 private:
  std::uint64_t generation_ = 0;  // of the assets that the meshes belong to
  std::map<std::uint32_t, bool> shuts_;
};

// Whether a mesh is as good as the box of its bounds to what would pass it along the box's thinnest axis: rigid,
// without holes or what is translucent, and its faces there cover the box's.
bool shuts(const scene::Assets& assets, const scene::Mesh& mesh, std::uint32_t material_base);

}  // namespace fb::render
