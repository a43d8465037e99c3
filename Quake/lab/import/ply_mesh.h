// Triangles of PLY files (Turk 1994), ASCII or binary: positions, normals, texture coordinates, faces of any number of
// corners.
#pragma once

#include <string>

#include "lab/import/scene_maker.h"

namespace fb::lab {

// Fails where the file is damaged, or has no faces.
Result<ImportedMesh> read_ply(const std::string& path);

}  // namespace fb::lab
