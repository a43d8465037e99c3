// Faces of a map's model as triangles.
#pragma once

#include <cstdint>
#include <string>

#include "formats/bsp.h"
#include "scene/assets.h"
#include "scene/library/map_materials.h"

namespace fb::scene {

// The world (model 0) or a submodel, in the map's coordinates. Each face becomes a fan that faces the side its plane
// (and back_side) says. Tool textures are left out, and so is what a liquid or a sky has twice, once for each
// side (coincident_faces.h): its material shows on both. The mesh may be empty.
Mesh make_brush_mesh(const formats::Bsp& bsp, std::uint32_t model, MapMaterials& materials, std::string name);

}  // namespace fb::scene
