// The sky of a map: the two layers of its sky texture, or a skybox's six images.
#pragma once

#include <string_view>

#include "formats/bsp.h"
#include "scene/library/asset_builder.h"
#include "scene/snapshot.h"

namespace fb::scene {

constexpr float kMaxSkyFactor = 4.0f;  // how far a dome light may brighten the painted sky

// From the first texture named sky...: its right half is the far layer, its left half the near one, where index 0 is a
// hole (alpha 0 in an image of colours). kBlack without such a texture. `dome_radiance`: the mean radiance wished for
// (lights.h); the factor on the texels stays within 1 and kMaxSkyFactor.
Sky make_layered_sky(AssetBuilder& builder, const formats::Bsp& bsp, const vec3& dome_radiance);

// gfx/env/<name> + rt bk lf ft up dn (with an underscore before the two letters if that is how they are called). With
// none of the six: `fallback` and one logged sentence.
Sky make_box_sky(AssetBuilder& builder, std::string_view name, const Sky& fallback);

}  // namespace fb::scene
