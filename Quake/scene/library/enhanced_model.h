// Models that stand in the place of others: .md5mesh (with .md5anim) and .md3 beside a .mdl, as in the re-release of
// 2021, vkQuake and Ironwail; and those that a mod names itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "formats/mdl.h"
#include "formats/posed_model.h"
#include "scene/library/asset_builder.h"

namespace fb::scene {

// All poses, on a grid of 2,048 steps over the model's width and depth and 1,024 over its height. Normals are made anew
// (pose_normals.h). Triangles that have no area in any pose are left out. A triangle's material is its surface's
// number.
Mesh make_posed_mesh(const formats::PosedModel& model, std::string name);

// Materials of a model: skin s has those of its surfaces from s * surfaces on.
struct PosedSkins {
  std::vector<std::uint32_t> first;  // one a skin: the material of its first surface; those of the others follow
};
// Images are files beside the model, .png, .tga, .pcx or .lmp, each with _luma or _glow, _norm, _gloss. Of a surface
// whose file names SHADER, in the model STEM.md3, skin 2, the first that is there of SHADER, progs/SHADER,
// textures/SHADER and STEM, with _02_00, _2_0, _02 or _2 behind it; skin 0 also without a number. The last number
// counts images that play in a loop, ten a second. A text STEM.md3_2.skin, or STEM_2.skin, names the images of the
// surfaces that it has lines for. `owner`: the model's file. An error names what is missing.
Result<PosedSkins> make_posed_skins(AssetBuilder& builder, const formats::PosedModel& model, std::string_view owner);

// The model of a .md3 or .md5mesh file; of the latter the .md5anim beside it, if there is one.
Result<formats::PosedModel> read_posed_model(const FileLoader& load, std::string_view path);

// As a Model, without what only a .mdl has (flags).
Result<Model> make_posed_model(AssetBuilder& builder, const formats::PosedModel& posed, const std::string& path);

// In the place of `mdl`, which is in the file `path`: the .md5mesh, or else the .md3, of the same name that ranks no
// lower; one that is wrong is said and left. The frames are `mdl`'s where there are as many poses as it has, or as it
// has frames; else each pose is a frame.
std::optional<Model> enhanced_model(AssetBuilder& builder, const FileLoader& load, const FileRank& rank,
                                    const formats::Mdl& mdl, const std::string& path);

}  // namespace fb::scene
