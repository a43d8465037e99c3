// Scenes of pbrt-v4 as scenes of ours: shapes (pbrt_shapes.h), materials (pbrt_materials.h), area, point, distant and
// even infinite lights, instances, the perspective camera.
#pragma once

#include <string>

#include "lab/import/imported_scene.h"

namespace fb::lab {

Result<ImportedScene> import_pbrt(const std::string& path);

}  // namespace fb::lab
