#include "scene/snapshot.h"

namespace fb::scene {
namespace {

bool glows(const Material& m) {
  return m.emission_kind == EmissionKind::kLava || m.emission_kind == EmissionKind::kTeleport;
}

}  // namespace

float opacity_of(const Material& material, const LiquidOpacity& opacity) {
  switch (material.opacity_from) {
    case OpacityFrom::kItself:
      break;
    case OpacityFrom::kWater:
      return opacity.water;
    case OpacityFrom::kSlime:
      return opacity.slime;
    case OpacityFrom::kLava:
      return opacity.lava;
    case OpacityFrom::kTeleport:
      return opacity.teleport;
  }
  return 1.0f;
}

bool lets_light_in(const Material& material, const LiquidOpacity& opacity) {
  if ((material.flags & kMaterialDielectric) != 0) return true;
  const bool of_player = material.opacity_from == OpacityFrom::kLava || material.opacity_from == OpacityFrom::kTeleport;
  return of_player && opacity_of(material, opacity) < 1.0f;
}

float opaque_share(const Material& material, const LiquidOpacity& opacity) {
  if ((material.flags & kMaterialLiquid) == 0 || !glows(material)) return 0.0f;
  return material.alpha * opacity_of(material, opacity);
}

}  // namespace fb::scene
