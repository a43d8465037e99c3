// glTF 2.0 scenes (gltf_file.h) as scenes of ours: triangles, metal and roughness, emission, lights of
// KHR_lights_punctual, glass of KHR_materials_transmission and _volume, the first camera; with what export_gltf writes
// in `extras`.
#pragma once

#include <string>

#include "lab/import/imported_scene.h"

namespace fb::lab {

Result<ImportedScene> import_gltf(const std::string& path);

}  // namespace fb::lab
