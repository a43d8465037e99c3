#include "client/camera_liquid.h"

#include "world/bsp_query.h"

namespace fb::cl {
namespace {

enum class Liquid { kNone, kWater, kSlime, kLava };

Liquid liquid_contents(const formats::Bsp& map, const vec3& point, std::uint32_t submodel) {
  const std::int32_t contents = world::point_contents(map, point, submodel);
  const bool current = contents <= formats::kContentsCurrent0 && contents >= formats::kContentsCurrentDown;
  if (contents == formats::kContentsSlime) return Liquid::kSlime;
  if (contents == formats::kContentsLava) return Liquid::kLava;
  return contents == formats::kContentsWater || current ? Liquid::kWater : Liquid::kNone;
}

bool is_clear_liquid(const scene::Material& material, const scene::LiquidOpacity& opacity) {
  return (material.flags & scene::kMaterialLiquid) != 0 && scene::lets_light_in(material, opacity);
}

// A teleporter's leafs hold water.
Liquid liquid_of(const scene::Material& material) {
  if (material.emission_kind == scene::EmissionKind::kSlime) return Liquid::kSlime;
  return material.emission_kind == scene::EmissionKind::kLava ? Liquid::kLava : Liquid::kWater;
}

}  // namespace

bool liquid_is_at(const formats::Bsp& map, const vec3& point) {
  return liquid_contents(map, point, 0) != Liquid::kNone;
}

std::uint32_t liquid_of_world(const formats::Bsp& map, const scene::Assets& assets, const scene::LiquidOpacity& opacity,
                              const vec3& point) {
  const Liquid contents = liquid_contents(map, point, 0);
  if (contents == Liquid::kNone) return scene::kNone;
  std::uint32_t any = scene::kNone;
  for (std::uint32_t i = 0; i < assets.materials.size(); ++i) {
    const scene::Material& material = assets.materials[i];
    if (!is_clear_liquid(material, opacity)) continue;
    if (liquid_of(material) == contents) return i;
    if (contents != Liquid::kLava) any = i;  // opaque lava is not what else the map holds
  }
  return any;
}

std::uint32_t liquid_of_submodel(const formats::Bsp& map, const scene::Assets& assets,
                                 const scene::LiquidOpacity& opacity, std::uint64_t submodel, std::uint32_t mesh,
                                 const mat4x3& transform, const vec3& point) {
  if (submodel >= map.models.size() || mesh >= assets.meshes.size()) return scene::kNone;
  const mat4x3 inverse = inverse_affine(transform);
  if (inverse == mat4x3(0.0f)) return scene::kNone;
  const vec3 there = transform_point(inverse, point);
  if (liquid_contents(map, there, static_cast<std::uint32_t>(submodel)) == Liquid::kNone) return scene::kNone;
  for (const scene::MeshTriangle& triangle : assets.meshes[mesh].triangles)
    if (triangle.material < assets.materials.size() && is_clear_liquid(assets.materials[triangle.material], opacity))
      return triangle.material;
  return scene::kNone;
}

}  // namespace fb::cl
