// A frame as a glTF 2.0 scene, for Blender and other renderers: what reflects and glows at that moment, with the
// camera.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/passes/settings.h"
#include "scene/snapshot.h"

namespace fb::lab {

struct GltfSummary {
  std::uint32_t triangles = 0, materials = 0, images = 0;
  std::vector<std::string> missing;  // what glTF cannot say, a sentence each
};

// Metres, y up; 1 unit is an inch. Radiance is emissive strength. Materials are metal and roughness with GGX of the
// same alpha, KHR_materials_specular for what is not 4%, KHR_materials_emissive_strength above 1; textures are read at
// their nearest texel, as here. Suns are directional lamps (KHR_lights_punctual, intensity in lux of 683 lumen a watt).
// `extras.fullbright` has what glTF has no word for: r_bounces, which rays see a node, a sun's radius, what lies behind
// everything. Settings give the factors of emission (r_emit_*). Fails where a file cannot be written.
Result<GltfSummary> export_gltf(const scene::FrameSnapshot& snapshot, const render::RenderSettings& settings,
                                uvec2 size, const std::string& path, const std::string& generator);

}  // namespace fb::lab
