// Checks of what this module's headers promise about parsed files: each function returns the first broken promise, or
// an empty string. For tests and fuzzers; deliberately written without the parsers' own helpers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/bsp.h"
#include "formats/image.h"
#include "formats/mdl.h"
#include "formats/posed_model.h"
#include "formats/spr.h"
#include "formats/wav.h"

namespace fb::formats::testing {

inline bool finite3(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline std::string broken_times(const std::vector<float>& times, std::size_t count) {
  if (times.empty()) return count == 1 ? "" : "a group without times";
  if (times.size() != count) return "times and images differ in number";
  float before = 0.0f;
  for (const float time : times) {
    if (!(time > 0.0f) || !(time >= before) || std::isinf(time)) return "a time that is not positive or goes down";
    before = time;
  }
  return "";
}

inline std::string broken_image(const IndexedImage& image) {
  if (image.width < 1 || image.height < 1 || image.width > kMaxImageSize || image.height > kMaxImageSize) {
    return "image size";
  }
  return image.indices.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)
             ? ""
             : "number of texels";
}

inline std::string broken_image(const RgbaImage& image) {
  if (image.width < 1 || image.height < 1 || image.width > kMaxImageSize || image.height > kMaxImageSize) {
    return "image size";
  }
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  return pixels <= kMaxImagePixels && image.rgba.size() == 4 * pixels ? "" : "number of pixels";
}

inline std::string broken(const Wav& wav) {
  if (wav.samples.empty()) return "no samples";
  if (wav.rate < kLowestRate || wav.rate > kHighestRate) return "a rate that is not played";
  if (wav.bits != 8 && wav.bits != 16) return "bits";
  if (wav.loop_start && *wav.loop_start >= wav.samples.size()) return "a loop that begins behind the last sample";
  return "";
}

inline std::string broken(const Spr& spr) {
  if (spr.frames.empty()) return "no frames";
  if (static_cast<int>(spr.orientation) < 0 || static_cast<int>(spr.orientation) > 4) return "orientation";
  if (!std::isfinite(spr.bounding_radius) || !std::isfinite(spr.beam_length)) return "a number that is not finite";
  for (const SprFrame& frame : spr.frames) {
    if (frame.images.empty()) return "an empty group";
    if (auto fault = broken_times(frame.end_times, frame.images.size()); !fault.empty()) return fault;
    for (const SprImage& image : frame.images) {
      if (auto fault = broken_image(image.image); !fault.empty()) return fault;
    }
  }
  return "";
}

inline std::string broken(const Mdl& mdl) {
  if (mdl.skins.empty() || mdl.frames.empty() || mdl.triangles.empty() || mdl.vertex_count == 0) return "emptiness";
  if (!finite3(mdl.scale) || !finite3(mdl.origin) || !finite3(mdl.eye_position) ||
      !std::isfinite(mdl.bounding_radius)) {
    return "a number that is not finite";
  }
  for (const MdlSkin& skin : mdl.skins) {
    if (skin.images.empty()) return "an empty group of skins";
    if (auto fault = broken_times(skin.end_times, skin.images.size()); !fault.empty()) return fault;
    for (const IndexedImage& image : skin.images) {
      if (image.width != mdl.skin_width || image.height != mdl.skin_height) return "size of a skin";
      if (auto fault = broken_image(image); !fault.empty()) return fault;
    }
  }
  if (mdl.tex_coords.size() != mdl.vertex_count) return "number of texture coordinates";
  for (const MdlTriangle& triangle : mdl.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) {
      if (vertex >= mdl.vertex_count) return "a triangle's vertex";
    }
  }
  std::uint64_t poses = 0;
  for (const MdlFrame& frame : mdl.frames) {
    if (frame.first_pose != poses || frame.pose_count == 0) return "a frame's poses";
    if (auto fault = broken_times(frame.end_times, frame.pose_count); !fault.empty()) return fault;
    poses += frame.pose_count;
  }
  if (poses != mdl.pose_count) return "number of poses";
  if (mdl.vertices.size() != std::size_t{mdl.pose_count} * mdl.vertex_count) return "number of vertices";
  for (const MdlVertex& vertex : mdl.vertices) {
    if (vertex.normal >= 162) return "a vertex' normal";
  }
  return "";
}

inline std::string broken(const PosedModel& model) {
  if (model.surfaces.empty() || model.vertex_count == 0 || model.pose_count == 0) return "emptiness";
  if (model.uv.size() != model.vertex_count || model.pose_names.size() != model.pose_count) return "numbers";
  const std::size_t all = std::size_t{model.vertex_count} * model.pose_count;
  if (model.positions.size() != all || all > kMostPosedVertices) return "number of positions";
  for (const vec3& p : model.positions)
    if (!finite3(p)) return "a position";
  for (const vec2& uv : model.uv)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a texture coordinate";
  for (const PosedSurface& surface : model.surfaces) {
    if (surface.triangles.empty()) return "a surface without triangles";
    for (const auto& triangle : surface.triangles)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= model.vertex_count) return "a triangle's vertex";
  }
  return "";
}

// Walks a tree as a user would, recursively; 0 when it is deeper than allowed.
template <typename Nodes>
std::uint32_t tree_depth(const Nodes& nodes, std::int32_t n, std::uint32_t left) {
  if (n < 0) return 1;
  if (left == 0) return 0;
  std::uint32_t deepest = 1;
  for (const std::int32_t child : nodes[static_cast<std::size_t>(n)].children) {
    const std::uint32_t depth = tree_depth(nodes, child, left - 1);
    if (depth == 0) return 0;
    deepest = std::max(deepest, depth + 1);
  }
  return deepest;
}

inline std::string broken_leafs(const std::vector<BspLeaf>& leafs, std::size_t mark_faces, std::size_t visibility) {
  for (const BspLeaf& leaf : leafs) {
    if (leaf.contents >= 0 || leaf.contents < -15) return "a leaf's contents";
    if (leaf.vis_offset < -1 || leaf.vis_offset >= static_cast<std::int64_t>(visibility)) return "a leaf's visibility";
    if (std::uint64_t{leaf.first_mark_face} + leaf.mark_face_count > mark_faces) return "a leaf's faces";
    if (!finite3(leaf.mins) || !finite3(leaf.maxs)) return "a leaf's box";
  }
  return "";
}

inline std::string broken(const Bsp& bsp) {
  for (const BspPlane& plane : bsp.planes) {
    if (!finite3(plane.normal) || !std::isfinite(plane.distance) || plane.type < 0 || plane.type > 5) return "a plane";
  }
  for (const BspTexture& texture : bsp.textures) {
    if (texture.name.size() > 15) return "a texture's name";
    if (texture.width < 1 || texture.height < 1 || texture.width > kMaxImageSize || texture.height > kMaxImageSize) {
      return "a texture's size";
    }
    if (!texture.missing() &&
        texture.indices.size() != static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height)) {
      return "a texture's texels";
    }
  }
  for (const vec3& vertex : bsp.vertices) {
    if (!finite3(vertex)) return "a vertex";
  }
  for (const BspTexInfo& info : bsp.texinfos) {
    if (info.texture != kNoTexture && info.texture >= bsp.textures.size()) return "a texinfo's texture";
    for (const vec4& axis : info.axes) {
      if (!finite3(vec3(axis.x, axis.y, axis.z)) || !std::isfinite(axis.w)) return "a texinfo's axis";
    }
  }
  for (const auto& edge : bsp.edges) {
    if (edge[0] >= bsp.vertices.size() || edge[1] >= bsp.vertices.size()) return "an edge's vertex";
  }
  for (const std::int32_t surfedge : bsp.surfedges) {
    if (std::abs(std::int64_t{surfedge}) >= static_cast<std::int64_t>(bsp.edges.size())) return "a surfedge's edge";
  }
  std::size_t light_samples = bsp.lighting.size();
  for (const auto& [name, bytes] : bsp.bspx) {
    if (name == "RGBLIGHTING") light_samples = std::max(light_samples, bytes.size() / 3);
  }
  for (const BspFace& face : bsp.faces) {
    if (face.plane >= bsp.planes.size() || face.texinfo >= bsp.texinfos.size()) return "a face's plane or texinfo";
    if (std::uint64_t{face.first_surfedge} + face.surfedge_count > bsp.surfedges.size()) return "a face's edges";
    if (face.light_offset < -1 || face.light_offset >= static_cast<std::int64_t>(light_samples)) {
      return "a face's light";
    }
    for (std::uint32_t k = 0; k < std::min(face.surfedge_count, 64u); ++k) {
      if (!finite3(bsp.face_vertex(face, k))) return "a face's vertex";
    }
  }
  for (const std::uint32_t face : bsp.mark_faces) {
    if (face >= bsp.faces.size()) return "a marksurface";
  }
  if (auto fault = broken_leafs(bsp.leafs, bsp.mark_faces.size(), bsp.visibility.size()); !fault.empty()) return fault;
  if (bsp.leafs.empty()) return "no leafs";
  for (const BspNode& node : bsp.nodes) {
    if (node.plane >= bsp.planes.size()) return "a node's plane";
    for (const std::int32_t child : node.children) {
      if (child >= 0 ? child >= static_cast<std::int64_t>(bsp.nodes.size())
                     : ~child >= static_cast<std::int64_t>(bsp.leafs.size())) {
        return "a node's child";
      }
    }
    if (std::uint64_t{node.first_face} + node.face_count > bsp.faces.size()) return "a node's faces";
    if (!finite3(node.mins) || !finite3(node.maxs)) return "a node's box";
  }
  for (const BspClipNode& node : bsp.clip_nodes) {
    if (node.plane >= bsp.planes.size()) return "a clip node's plane";
    for (const std::int32_t child : node.children) {
      if (child < -15 || child >= static_cast<std::int64_t>(bsp.clip_nodes.size())) return "a clip node's child";
    }
  }
  if (bsp.models.empty()) return "no world";
  for (const BspModel& model : bsp.models) {
    if (!finite3(model.mins) || !finite3(model.maxs) || !finite3(model.origin)) return "a model's box";
    if (model.head_nodes[0] >= 0 ? model.head_nodes[0] >= static_cast<std::int64_t>(bsp.nodes.size())
                                 : ~model.head_nodes[0] >= static_cast<std::int64_t>(bsp.leafs.size())) {
      return "a model's head node";
    }
    for (std::size_t hull = 1; hull < 4; ++hull) {
      if (model.head_nodes[hull] < -15 || model.head_nodes[hull] >= static_cast<std::int64_t>(bsp.clip_nodes.size())) {
        return "a model's hull";
      }
    }
    if (model.visible_leafs >= bsp.leafs.size()) return "a model's visible leafs";
    if (std::uint64_t{model.first_face} + model.face_count > bsp.faces.size()) return "a model's faces";
  }
  // Models may be many and share a root: walk each root once.
  std::vector<bool> walked(bsp.nodes.size(), false);
  for (const BspModel& model : bsp.models) {
    const std::int32_t root = model.head_nodes[0];
    if (root < 0 || walked[static_cast<std::size_t>(root)]) continue;
    walked[static_cast<std::size_t>(root)] = true;
    if (tree_depth(bsp.nodes, root, kMaxBspDepth) == 0) return "a node tree's depth";
  }
  return "";
}

}  // namespace fb::formats::testing
