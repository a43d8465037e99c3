// LightList: the triangles that glow, by the power that each is thought to have: area times mean radiance. For
// estimators that sample lights, which stay right whatever it says: what is missing there they find by chance. Made
// anew when what glows has changed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/scene/gpu_scene_assets.h"
#include "render/scene/lamp_numbers.h"
#include "scene/snapshot.h"
#include "shared/scene_gpu.h"

namespace fb::render {

// Raised when lists of the same scene come out otherwise than before (triangles, their powers, lamps, alias tables):
// pictures that look for lights differ then, and references made before are not taken for them.
constexpr std::uint32_t kLightListVersion = 1;

class LightList {
 public:
  // An instance in the order of the table that shaders see.
  struct Source {
    const scene::Instance* instance = nullptr;
    const MeshRecord* mesh = nullptr;
    const shared::GpuInstance* gpu = nullptr;
  };
  // `materials`: what GpuInstance::material_base counts in. Meshes are `assets`' own, their records' order that of
  // leaves. Of more than `most` triangles, those of the last instances are not listed.
  void build(const scene::Assets& assets, const scene::Sky& sky, std::span<const Source> sources,
             std::span<const shared::GpuMaterial> materials, std::uint64_t most = shared::kLightRange);
  // As Shaders/shared/scene_gpu.h has them.
  const std::vector<std::uint32_t>& first_lights() const { return first_lights_; }  // of each instance
  const std::vector<shared::GpuLight>& lights() const { return lights_; }
  const std::vector<shared::GpuLamp>& lamps() const { return lamps_; }  // those that are new say so for one build()
  float power() const { return power_; }         // of all: area times mean radiance, sum of the channels
  bool made_anew() const { return made_anew_; }  // by the last build(): not the former list

 private:
  // Mean linear colour of an image's texels: of all, and of those alone that glow by their palette index.
  struct Means {
    vec3 all{0.0f}, glowing{0.0f};
  };
  const Means& means(const scene::Assets& assets, std::uint32_t image);
  // An instance of which something glows: all that its part of the list comes from, but for the materials' radiance.
  struct Glowing {
    std::uint32_t instance = 0, id = 0, mesh = 0, material_base = 0;
    bool colored = false;
    float color = 0;  // sum of the channels
    mat4x3 transform{1.0f};
    scene::PoseBlend pose;
    bool operator==(const Glowing&) const = default;
  };
  static std::vector<Glowing> find_glowing(std::span<const Source> sources, std::span<const float> glow,
                                           std::uint64_t most);
  void list_triangles(const scene::Assets& assets, std::span<const Source> sources);
  std::vector<std::vector<std::uint32_t>> find_lamps(std::uint32_t instance) const;
  void list_lamps();
  void mark_new_lamps(std::span<const std::uint64_t> former);
  std::vector<std::uint32_t> lamp_shares(std::span<const std::uint32_t> members) const;
  const std::vector<float>& areas(const scene::Assets& assets, const Source& source);
  float radiance(const scene::Assets& assets, const shared::GpuMaterial& material, float sky);
  float sky_radiance(const scene::Assets& assets, const scene::Sky& sky);

  std::uint64_t generation_ = 0;
  std::vector<std::optional<Means>> means_;
  std::vector<std::uint32_t> first_lights_;
  std::vector<shared::GpuLight> lights_;
  std::vector<shared::GpuLamp> lamps_;
  std::vector<std::uint64_t> members_;  // of each lamp: a hash of its instance and triangles; 0: it has none
  LampNumbers numbers_;
  float power_ = 0;
  bool made_anew_ = false, any_new_ = false;  // any_new_: lamps that say kLampIsNew
  std::vector<Glowing> glowing_;
  std::vector<float> glow_;  // of the materials: radiance, sum of the channels
  // Twice the area of each triangle of an instance in the world, in the order of leaves, while it stays where it is.
  struct Areas {
    std::uint32_t mesh = 0;
    mat4x3 transform{0.0f};
    scene::PoseBlend pose;
    std::vector<float> of;
  };
  std::unordered_map<std::uint32_t, Areas> areas_;  // by the instance's id
};

}  // namespace fb::render
