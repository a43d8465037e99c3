#include "render/scene/gpu_scene_tables.h"

#include <glm/gtc/packing.hpp>

#include "render/scene/gpu_scene_copies.h"

namespace fb::render {
namespace {

constexpr float kLeastCast = 1e-3f;  // what its inverse, a half, can still be

shared::GpuMaterial resolve(const scene::Material& m, double time, bool alternate, const EmissionScales& scales,
                            Interfaces interfaces, scene::LiquidOpacity opacity, bool authored, float style,
                            std::size_t number) {
  const scene::TextureSet& set = scene::texture_at(m, time, alternate);
  shared::GpuMaterial out{};
  out.base = set.base;
  out.luma = set.luma;
  out.normal = set.normal;
  out.gloss = set.gloss;
  out.base_color = vec4(m.base_color, m.alpha);
  const float lit = m.switched ? style : 1.0f;
  const vec3 cast = authored ? glm::max(m.cast * style, vec3(kLeastCast)) : vec3(1.0f);
  out.emission = vec4(m.emission * emission_scale(scales, m.emission_kind) * cast * (authored ? 1.0f : lit), 0);
  const bool painted = authored && m.emission_kind != scene::EmissionKind::kConstant;
  const vec3 own =
      painted ? glm::max(m.emission, vec3(kLeastCast)) * scene::usual_emission(m.emission_kind) : vec3(1.0f);
  const vec3 seen = (authored ? lit : 1.0f) / (cast * own);
  // Quake draws liquids that glow as they are painted, with no light on them.
  const bool glows = m.emission_kind == scene::EmissionKind::kLava || m.emission_kind == scene::EmissionKind::kSlime ||
                     m.emission_kind == scene::EmissionKind::kTeleport;
  if (authored && glows) out.base_color = vec4(vec3(0.0f), m.alpha);
  out.seen_rg = glm::packHalf2x16(vec2(seen.x, seen.y));
  out.seen_b = glm::packHalf2x16(vec2(seen.z, authored ? m.cast_fall : 0.0f));
  out.roughness = m.roughness;
  out.specular = m.specular;
  out.metalness = m.metalness;
  if (authored && m.gloss_by_name && set.gloss == scene::kNone) {
    out.roughness = 1.0f;
    out.specular = 0.0f;
  }
  out.flags = m.flags;
  out.emission_kind = static_cast<std::uint32_t>(m.emission_kind);
  if (!scene::lets_light_in(m, opacity)) return out;
  const bool liquid = (m.flags & scene::kMaterialLiquid) != 0;
  // Shaders tell by 16 bits what a point is in: the materials after that many are surfaces like any other.
  constexpr std::size_t kMostInside = 0xffff;
  if ((liquid ? interfaces.water : interfaces.glass) && number < kMostInside) {
    out.flags |= scene::kMaterialDielectric;
    out.base_color.w = 1.0f;
    out.specular = 0.0f;
    out.opaque_share = scene::opaque_share(m, opacity);
    if (out.opaque_share > 0.0f) {
      out.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);  // what it reflects, the interface does
    } else {                                          // an interface alone has no glow of its own
      out.emission = vec4(0.0f);
      out.emission_kind = shared::kEmissionNone;
    }
    out.emission.w = m.index;
    const float factor = scene::opacity_of(m, opacity);
    out.extinction_r = (m.absorption.x + m.scattering) * factor;
    out.extinction_g = (m.absorption.y + m.scattering) * factor;
    out.extinction_b = (m.absorption.z + m.scattering) * factor;
    out.scattering = m.scattering * interfaces.scattering * factor;
  } else {
    out.flags &= ~static_cast<std::uint32_t>(scene::kMaterialDielectric);
  }
  return out;
}

void set_rows(vec4 (&rows)[3], const mat4x3& m) {
  for (int i = 0; i < 3; ++i) rows[i] = vec4(m[0][i], m[1][i], m[2][i], m[3][i]);
}

}  // namespace

float emission_scale(const EmissionScales& scales, scene::EmissionKind kind) {
  auto index = static_cast<std::size_t>(kind);
  return kind == scene::EmissionKind::kConstant || index >= scales.size() ? 1.0f : scales[index];
}

void MaterialTable::begin(const scene::Assets& assets, double time, const EmissionScales& scales, Interfaces interfaces,
                          scene::LiquidOpacity opacity, bool authored, const std::array<float, 64>& styles) {
  entries_.clear();
  entries_.reserve(2 * assets.materials.size());
  time_ = time;
  scales_ = scales;
  interfaces_ = interfaces;
  opacity_ = opacity;
  authored_ = authored;
  styles_ = styles;
  for (bool alternate : {false, true}) {
    for (const scene::Material& m : assets.materials)
      entries_.push_back(
          resolve(m, time, alternate, scales, interfaces, opacity, authored, style_of(m), entries_.size()));
  }
}

float MaterialTable::style_of(const scene::Material& m) const {
  const auto style = static_cast<std::size_t>(m.cast_style);
  return style < styles_.size() ? styles_[style] : 1.0f;
}

std::uint32_t MaterialTable::base_for(const scene::Assets& assets, const MeshRecord& mesh,
                                      const scene::Instance& instance) {
  const bool alternate = (instance.flags & scene::kInstanceAlternate) != 0;
  const bool own_clock = instance.time_offset != 0.0f && (instance.flags & scene::kInstanceShareTime) == 0;
  if (own_clock && mesh.materials.size() == 1) {
    std::uint32_t index = mesh.materials[0] + instance.material_base;
    const scene::Material& m = assets.materials[index];
    if (m.frames.size() > 1 || m.alternate_frames.size() > 1) {
      entries_.push_back(resolve(m, time_ - static_cast<double>(instance.time_offset), alternate, scales_, interfaces_,
                                 opacity_, authored_, style_of(m), entries_.size()));
      return static_cast<std::uint32_t>(entries_.size()) - 1 - mesh.materials[0];
    }
  }
  return instance.material_base + (alternate ? static_cast<std::uint32_t>(assets.materials.size()) : 0u);
}

std::uint32_t features_of(const scene::Assets& assets) {
  std::uint32_t features = 0;
  for (const scene::Mesh& mesh : assets.meshes)
    if (mesh.posed() || !mesh.normals.empty()) features |= shared::kFeatureSmooth;
  for (const scene::Material& m : assets.materials) {
    if ((m.flags & scene::kMaterialWarp) != 0) features |= shared::kFeatureWarp;
    for (const auto* frames : {&m.frames, &m.alternate_frames}) {
      for (const scene::TextureSet& set : *frames) {
        if (set.luma != scene::kNone) features |= shared::kFeatureLuma;
        if (set.normal != scene::kNone || set.gloss != scene::kNone) features |= shared::kFeatureDetail;
      }
    }
  }
  return features;
}

std::uint32_t features_of(const scene::Sky& sky) {
  const bool textured = sky.mode == scene::SkyMode::kLayers || sky.mode == scene::SkyMode::kBox;
  return (textured ? shared::kFeatureSkyTexture : 0u) | (sky.suns.empty() ? 0u : shared::kFeatureSuns);
}

MaterialNeeds needs_of(const scene::Assets& assets, const MeshRecord& mesh, std::uint32_t material_base,
                       Interfaces interfaces, const scene::LiquidOpacity& opacity) {
  MaterialNeeds needs;
  for (std::uint32_t relative : mesh.materials) {
    std::uint64_t index = std::uint64_t{relative} + material_base;
    if (index >= assets.materials.size()) {
      needs.known = false;
      continue;
    }
    const scene::Material& m = assets.materials[index];
    const bool dielectric = scene::lets_light_in(m, opacity);
    const bool liquid = (m.flags & scene::kMaterialLiquid) != 0;
    needs.water |= dielectric && liquid;
    needs.glass |= dielectric && !liquid;
    needs.turbid |= dielectric && m.scattering > 0.0f && (liquid ? interfaces.water : interfaces.glass);
    needs.skins |= dielectric && scene::opaque_share(m, opacity) > 0.0f;
    needs.glass_alone &= dielectric && !liquid;
    needs.alpha_test |= (m.flags & scene::kMaterialAlphaTest) != 0;
    needs.translucent |= m.alpha < 1.0f;
    needs.veils |= liquid && !interfaces.water && m.alpha > 0.0f && m.alpha < 1.0f;
    needs.specular |= m.specular > 0.0f || m.metalness > 0.0f;
  }
  return needs;
}

shared::GpuInstance make_gpu_instance(const MeshRecord& mesh, const scene::Instance& instance, const mat4x3& inverse,
                                      std::uint32_t material_base, float scale) {
  shared::GpuInstance out{};
  const bool is_new = (instance.flags & scene::kInstanceNew) != 0;
  set_rows(out.to_world, instance.transform);
  for (int i = 0; i < 3; ++i)
    out.to_object[i] = vec4(inverse[0][i], inverse[1][i], inverse[2][i], instance.transform[3][i]);
  set_rows(out.prev_to_world, is_new ? instance.transform : instance.prev_transform);
  out.first_attribute = mesh.first_attribute;
  out.first_normal = mesh.first_normal;
  out.pose_a = out.pose_b = out.prev_pose_a = out.prev_pose_b = shared::kNoIndex;
  if (mesh.posed) {
    scene::PoseBlend pose = InstanceCopies::canonical(mesh, instance.pose);
    scene::PoseBlend prev = is_new ? pose : InstanceCopies::canonical(mesh, instance.prev_pose);
    auto first_vertex = [&](std::uint32_t index) { return mesh.first_pose_vertex + index * mesh.vertex_count; };
    out.pose_a = first_vertex(pose.a);
    out.pose_b = first_vertex(pose.b);
    out.pose_t = pose.t;
    out.prev_pose_a = first_vertex(prev.a);
    out.prev_pose_b = first_vertex(prev.b);
    out.prev_pose_t = prev.t;
  }
  out.material_base = material_base;
  out.flags = instance.visibility & shared::kInstanceMaskBits;
  if ((instance.flags & scene::kInstanceColor) != 0) out.flags |= shared::kInstanceHasColor;
  const bool posed_anew =
      mesh.posed && (out.pose_a != out.prev_pose_a || out.pose_b != out.prev_pose_b || out.pose_t != out.prev_pose_t);
  if (posed_anew || (!is_new && instance.transform != instance.prev_transform)) out.flags |= shared::kInstanceMoves;
  if (is_new) out.flags |= shared::kInstanceIsNew;
  out.id = instance.id;
  out.alpha = instance.alpha;
  out.time_offset = instance.time_offset;
  out.triangle_count = mesh.triangle_count;
  const bool spot = (instance.flags & scene::kInstanceSpot) != 0;
  if (spot)
    out.flags |= shared::kInstanceIsSpot | ((instance.flags >> scene::kInstanceFallShift) & 7u)
                                               << shared::kInstanceFallShift;
  out.color = spot ? vec4(0.0f, 0.0f, 0.0f, instance.color.x) : vec4(instance.color, 0);
  const bool colored = (instance.flags & scene::kInstanceColor) != 0;  // else it is even light
  out.emission = vec4(instance.emission * (colored ? scale : 1.0f), spot ? instance.color.y : 0.0f);
  out.pose_scale = spot ? vec4(instance.color.z, 0.0f, 0.0f, 0.0f) : vec4(mesh.pose_scale, 0);
  out.pose_origin = vec4(mesh.pose_origin, 0);
  return out;
}

}  // namespace fb::render
