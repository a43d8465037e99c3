// For tests and fuzzers: what must hold of all Assets, whatever files they came from.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "scene/assets.h"

namespace fb::scene::test {

inline bool finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline std::string broken(const Assets& assets, const Mesh& mesh) {
  if (mesh.triangles.empty()) return "no triangles";
  if (mesh.positions.size() != (mesh.posed() ? 0u : mesh.vertex_count)) return "positions";
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.vertex_count) return "normals";
  if (mesh.poses.size() != std::size_t{mesh.pose_count} * mesh.vertex_count) return "poses";
  if (!finite(mesh.bounds.min) || !finite(mesh.bounds.max) || mesh.bounds.empty()) return "bounds";
  for (const vec3& p : mesh.positions)
    if (!finite(p)) return "a position is not finite";
  for (const MeshTriangle& t : mesh.triangles) {
    if (t.material >= assets.materials.size()) return "a triangle's material";
    for (std::uint32_t v : t.vertices)
      if (v >= mesh.vertex_count) return "a triangle's vertex";
    for (const vec2& uv : t.uv)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a texture coordinate is not finite";
  }
  return {};
}

inline std::string broken(const Assets& assets, const Material& material) {
  for (const auto* sets : {&material.frames, &material.alternate_frames})
    for (const TextureSet& set : *sets) {
      if (set.base >= assets.images.size()) return "a base image";
      for (std::uint32_t image : {set.luma, set.normal, set.gloss})
        if (image != kNone && image >= assets.images.size()) return "an image";
    }
  if (!material.end_times.empty() && material.end_times.size() != material.frames.size()) return "end times";
  if (!(material.alpha > 0.0f && material.alpha <= 1.0f)) return "alpha";
  if (!finite(material.emission) || !finite(material.base_color)) return "a colour is not finite";
  return {};
}

// Empty, or the first thing that is wrong.
inline std::string broken(const Assets& assets) {
  for (const Mesh& mesh : assets.meshes)
    if (const std::string fault = broken(assets, mesh); !fault.empty())
      return fmt::format("mesh {}: {}", mesh.name, fault);
  for (const Material& material : assets.materials)
    if (const std::string fault = broken(assets, material); !fault.empty())
      return fmt::format("material {}: {}", material.name, fault);
  for (const Image& image : assets.images) {
    const std::size_t texel = image.encoding == ImageEncoding::kPalette ? 1 : 4;
    if (image.width <= 0 || image.height <= 0 ||
        image.texels.size() != texel * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
      return fmt::format("image {}: size", image.name);
  }
  return {};
}

}  // namespace fb::scene::test
