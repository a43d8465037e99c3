// This frame's tables: materials with their textures resolved for the time, and instances as shaders see them.
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/gpu_scene.h"
#include "render/scene/gpu_scene_assets.h"
#include "scene/snapshot.h"
#include "shared/kinds.h"
#include "shared/scene_gpu.h"

namespace fb::render {

// Entry i is assets' material i; entry i + their number is the same with its alternate frames. Behind these come
// entries of instances whose animation runs on a clock of their own.
class MaterialTable {
 public:
  // `authored`: whether Material::cast counts, times its style's factor.
  void begin(const scene::Assets& assets, double time, const EmissionScales& scales, Interfaces interfaces = {},
             scene::LiquidOpacity opacity = {}, bool authored = false,
             const std::array<float, 64>& styles = scene::all_styles_of_one());
  // What to add to the triangles' materials for this instance.
  std::uint32_t base_for(const scene::Assets& assets, const MeshRecord& mesh, const scene::Instance& instance);
  const std::vector<shared::GpuMaterial>& entries() const { return entries_; }

 private:
  std::vector<shared::GpuMaterial> entries_;
  double time_ = 0;
  EmissionScales scales_{};
  Interfaces interfaces_;
  scene::LiquidOpacity opacity_;
  bool authored_ = false;
  std::array<float, 64> styles_ = scene::all_styles_of_one();
  float style_of(const scene::Material& m) const;
};

// What an instance's materials ask of the shaders; `known` is false if it names a material that does not exist.
struct MaterialNeeds {
  bool known = true, alpha_test = false, translucent = false, specular = false;
  bool water = false, glass = false;  // some material of it can be an interface of a liquid; of glass
  bool veils = false;                 // some liquid of it is translucent and no interface
  bool turbid = false;                // behind some interface light is scattered
  bool skins = false;                 // a share of some interface is opaque
  bool glass_alone = true;            // all are of glass
};
MaterialNeeds needs_of(const scene::Assets& assets, const MeshRecord& mesh, std::uint32_t material_base,
                       Interfaces interfaces = {}, const scene::LiquidOpacity& opacity = {});

// What surfaces of any instance could need, and the sky of this frame does: shared::kFeature*.
std::uint32_t features_of(const scene::Assets& assets);
std::uint32_t features_of(const scene::Sky& sky);

float emission_scale(const EmissionScales& scales, scene::EmissionKind kind);

// Everything of a GpuInstance but the tree's and the triangles' place.
shared::GpuInstance make_gpu_instance(const MeshRecord& mesh, const scene::Instance& instance, const mat4x3& inverse,
                                      std::uint32_t material_base, float emission_scale);

}  // namespace fb::render
