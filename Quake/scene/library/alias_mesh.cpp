#include "scene/library/alias_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include <glm/vec3.hpp>

#include "scene/library/pose_normals.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

using formats::Mdl;
using formats::MdlVertex;

const MdlVertex& vertex_in(const Mdl& mdl, std::uint32_t pose, std::uint32_t vertex) {
  return mdl.vertices[static_cast<std::size_t>(pose) * mdl.vertex_count + vertex];
}
bool ever_has_area(const Mdl& mdl, const std::array<std::uint32_t, 3>& v) {
  for (std::uint32_t pose = 0; pose < mdl.pose_count; ++pose) {
    const MdlVertex &a = vertex_in(mdl, pose, v[0]), &b = vertex_in(mdl, pose, v[1]), &c = vertex_in(mdl, pose, v[2]);
    const glm::ivec3 u(b.x - a.x, b.y - a.y, b.z - a.z), w(c.x - a.x, c.y - a.y, c.z - a.z);
    if (u.y * w.z != u.z * w.y || u.z * w.x != u.x * w.z || u.x * w.y != u.y * w.x) return true;
  }
  return false;
}

// Relative to the model's origin.
std::vector<vec3> positions_of(const Mdl& mdl) {
  std::vector<vec3> positions;
  positions.reserve(mdl.vertices.size());
  for (const MdlVertex& v : mdl.vertices) positions.push_back(vec3(v.x, v.y, v.z) * mdl.scale);
  return positions;
}

}  // namespace

Mesh make_alias_mesh(const Mdl& mdl, std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.vertex_count = mdl.vertex_count;
  mesh.pose_count = mdl.pose_count;
  mesh.pose_scale = mdl.scale;
  mesh.pose_origin = mdl.origin;
  const vec2 skin_size(std::max(mdl.skin_width, 1), std::max(mdl.skin_height, 1));
  for (const formats::MdlTriangle& source : mdl.triangles) {
    // Files have them clockwise as seen from outside.
    const std::array<std::uint32_t, 3> v{source.vertices[0], source.vertices[2], source.vertices[1]};
    if (!ever_has_area(mdl, v)) continue;
    MeshTriangle triangle{v, 0, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const formats::MdlTexCoord& t = mdl.tex_coords[v[k]];
      const int shift = !source.faces_front && t.on_seam ? mdl.skin_width / 2 : 0;
      triangle.uv[k] =
          vec2(static_cast<float>(t.s) + static_cast<float>(shift) + 0.5f, static_cast<float>(t.t) + 0.5f) / skin_size;
    }
    mesh.triangles.push_back(triangle);
  }
  const std::vector<vec3> positions = positions_of(mdl);
  const PoseNormals pose_normals(positions, mdl.vertex_count, mesh.triangles);
  mesh.poses.reserve(static_cast<std::size_t>(mdl.pose_count) * mdl.vertex_count);
  for (std::uint32_t pose = 0; pose < mdl.pose_count; ++pose) {
    const std::vector<vec3> normals = pose_normals.normals(pose);
    for (std::uint32_t v = 0; v < mdl.vertex_count; ++v) {
      const MdlVertex& p = vertex_in(mdl, pose, v);
      mesh.poses.push_back(make_pose_vertex(p.x, p.y, p.z, normals[v]));
    }
  }
  finish_mesh(mesh);
  return mesh;
}

std::vector<std::uint32_t> make_skin_materials(AssetBuilder& builder, const Mdl& mdl, std::string_view name) {
  const bool holes = (mdl.flags & formats::kMdlHoley) != 0;
  // QuakeSpasm draws these at full brightness whatever lights them; here all of their texels glow.
  const std::string lower = lower_case(name);
  const bool flame = lower == "progs/flame.mdl" || lower == "progs/flame2.mdl" || lower == "progs/flame0.mdl";
  std::vector<std::uint32_t> materials;
  for (std::size_t s = 0; s < mdl.skins.size(); ++s) {
    const formats::MdlSkin& skin = mdl.skins[s];
    const std::string skin_name = fmt::format("{}_{}", name, s);
    Material material;
    material.name = skin_name;
    material.emission = vec3(1.0f);
    material.flags = kMaterialClampTexture | (holes ? kMaterialAlphaTest : 0u);
    material.end_times = skin.end_times;
    bool glows = false;
    for (std::size_t i = 0; i < skin.images.size(); ++i) {
      const formats::IndexedImage& image = skin.images[i];
      const std::string image_name = fmt::format("{}_{}", skin_name, i);
      std::vector<std::string> stems{image_name};
      if (i == 0) stems.push_back(skin_name);
      TextureSet set = builder.replacement(stems, name);
      const bool replaced = set.base != kNone, bright = flame || has_fullbright(image.indices, holes);
      if (!replaced)
        set.base = builder.add_image({image_name, ImageEncoding::kPalette, image.width, image.height, image.indices});
      if (set.luma == kNone && flame) set.luma = set.base;
      if (set.luma == kNone && bright && replaced)
        set.luma = builder.add_image(
            luma_from_indices(builder.palette(), image_name, image.width, image.height, image.indices, holes));
      if (set.gloss != kNone) material.specular = 0.04f;
      glows |= bright || set.luma != kNone;
      material.frames.push_back(set);
    }
    material.emission_kind = glows ? EmissionKind::kFullbright : EmissionKind::kNone;
    builder.refract(material, {skin_name}, name);
    materials.push_back(builder.add_material(std::move(material)));
  }
  return materials;
}

}  // namespace fb::scene
