// Scenes that other programs wrote: glTF 2.0 (.gltf, .glb) and pbrt-v4 (.pbrt), as snapshots. What these say that a
// snapshot cannot is left out, and named.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "lab/frame_source.h"
#include "scene/snapshot.h"

namespace fb::lab {

struct ImportedScene {
  scene::FrameSnapshot snapshot;      // it stands still in space and in time
  std::vector<std::string> left_out;  // a sentence each
};

// Whether a scene's name is a file's of one of these kinds.
bool is_imported_scene(std::string_view name);

// 1 unit is an inch, and a file's unit a metre (pbrt has none: a scene that is far too small or too large for the
// renderer's numbers is scaled, which changes no light but that of points; it is said). Files that a scene names are
// looked for beside it. Fails with one sentence where the file is damaged or has no triangles.
Result<ImportedScene> import_scene(const std::string& path);

// The same as frames; it never ends. `left_out`, if not null, has what the file says and the scene does not.
Result<std::unique_ptr<FrameSource>> imported_source(const std::string& path, std::vector<std::string>* left_out);

}  // namespace fb::lab
