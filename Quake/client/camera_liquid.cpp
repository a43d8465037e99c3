#include "client/camera_liquid.h"

#include "world/bsp_query.h"

namespace fb::cl {
namespace {

enum class Clear { kNone, kWater, kSlime };

Clear clear_contents(const formats::Bsp& map, const vec3& point, std::uint32_t submodel) {
  const std::int32_t contents = world::point_contents(map, point, submodel);
  const bool current = contents <= formats::kContentsCurrent0 && contents >= formats::kContentsCurrentDown;
  if (contents == formats::kContentsSlime) return Clear::kSlime;
  return contents == formats::kContentsWater || current ? Clear::kWater : Clear::kNone;
}

bool is_clear_liquid(const scene::Material& material) {
  constexpr std::uint32_t kBoth = scene::kMaterialDielectric | scene::kMaterialLiquid;
  return (material.flags & kBoth) == kBoth;
}

}  // namespace

bool liquid_is_at(const formats::Bsp& map, const vec3& point) {
  return clear_contents(map, point, 0) != Clear::kNone || world::point_contents(map, point) == formats::kContentsLava;
}

std::uint32_t liquid_of_world(const formats::Bsp& map, const scene::Assets& assets, const vec3& point) {
  const Clear contents = clear_contents(map, point, 0);
  if (contents == Clear::kNone) return scene::kNone;
  std::uint32_t any = scene::kNone;
  for (std::uint32_t i = 0; i < assets.materials.size(); ++i) {
    const scene::Material& material = assets.materials[i];
    if (!is_clear_liquid(material)) continue;
    if ((material.emission_kind == scene::EmissionKind::kSlime) == (contents == Clear::kSlime)) return i;
    any = i;
  }
  return any;
}

std::uint32_t liquid_of_submodel(const formats::Bsp& map, const scene::Assets& assets, std::uint64_t submodel,
                                 std::uint32_t mesh, const mat4x3& transform, const vec3& point) {
  if (submodel >= map.models.size() || mesh >= assets.meshes.size()) return scene::kNone;
  const mat4x3 inverse = inverse_affine(transform);
  if (inverse == mat4x3(0.0f)) return scene::kNone;
  const vec3 there = transform_point(inverse, point);
  if (clear_contents(map, there, static_cast<std::uint32_t>(submodel)) == Clear::kNone) return scene::kNone;
  for (const scene::MeshTriangle& triangle : assets.meshes[mesh].triangles)
    if (triangle.material < assets.materials.size() && is_clear_liquid(assets.materials[triangle.material]))
      return triangle.material;
  return scene::kNone;
}

}  // namespace fb::cl
