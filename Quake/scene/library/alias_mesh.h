// Alias models as posed meshes, and their skins as materials.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mdl.h"
#include "scene/library/asset_builder.h"

namespace fb::scene {

// All poses of the model. Normals are made anew from each pose's geometry (weighted by the corners' angles; vertices at
// the same place in every pose are smoothed together unless they face away from each other), since the table of 162
// directions in the file is coarse. Triangles that are lines or points in every pose are left out. Texture coordinates
// are a corner's own, so that the seam needs no extra vertices.
Mesh make_alias_mesh(const formats::Mdl& mdl, std::string name);

// A material for each skin; a group's images are its frames. `name` is the model's path: images named
// <name>_<skin> or <name>_<skin>_<image> replace the skin's (e.g. progs/ogre.mdl_0.png, progs/ogre.mdl_0_luma.png).
std::vector<std::uint32_t> make_skin_materials(AssetBuilder& builder, const formats::Mdl& mdl, std::string_view name);

}  // namespace fb::scene
