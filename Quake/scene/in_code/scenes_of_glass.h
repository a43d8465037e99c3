// Scenes made in code whose light goes through glass.
#pragma once

#include "scene/snapshot.h"

namespace fb::scene {

// Hard: rings within a block of glass, and a ring of glass before it, lit by one small lamp. A straight ray from what
// is within the block never finds the lamp, and glass throws caustics on the floor. A room, 512 x 512 x 256; the block,
// of teal glass, is 128 x 104 x 96 units. Lamps of all radii give the same light.
FrameSnapshot torus(float lamp_radius = 10.0f);

// A ring that lies flat about 0 0 0, with smooth normals: `radius` of its middle line, `tube` of its section. Nothing
// else may be in the mesh.
void add_torus(Mesh& mesh, float radius, float tube, std::uint32_t material, int sides = 48, int facets = 24);

}  // namespace fb::scene
