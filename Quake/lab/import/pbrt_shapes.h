// Shapes of pbrt-v4 as triangles.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lab/import/pbrt_text.h"
#include "lab/import/scene_maker.h"

namespace fb::lab {

// In the shape's own space; the texture's v runs down, as here. None, and `left_out` a sentence, where the shape has no
// triangles here. Fails where it is damaged.
Result<std::optional<ImportedMesh>> pbrt_shape(const PbrtDirective& shape, const std::filesystem::path& folder,
                                               std::string& left_out);

}  // namespace fb::lab
