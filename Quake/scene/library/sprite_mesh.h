// Sprites as quads: a mesh and a material for every image, glowing as Quake draws them.
#pragma once

#include <string_view>
#include <vector>

#include "formats/spr.h"
#include "scene/library/asset_builder.h"

namespace fb::scene {

// How the quads stand is said at Model::SpriteFrame.
std::vector<Model::SpriteFrame> make_sprite_frames(AssetBuilder& builder, const formats::Spr& spr,
                                                   std::string_view name);

}  // namespace fb::scene
