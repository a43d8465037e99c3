// LightList: the triangles that glow, by the power that each is thought to have: area times mean radiance. For
// estimators that sample lights, which stay right whatever it says: what is missing there they find by chance. Made
// anew when what glows has changed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/gpu_scene_assets.h"
#include "scene/snapshot.h"
#include "shared/scene_gpu.h"

namespace fb::render {

class LightList {
 public:
  // An instance in the order of the table that shaders see.
  struct Source {
    const scene::Instance* instance = nullptr;
    const MeshRecord* mesh = nullptr;
    const shared::GpuInstance* gpu = nullptr;
  };
  // `materials`: what GpuInstance::material_base counts in. Meshes are `assets`' own, their records' order that of
  // leaves.
  void build(const scene::Assets& assets, const scene::Sky& sky, std::span<const Source> sources,
             std::span<const shared::GpuMaterial> materials);
  // As Shaders/shared/scene_gpu.h has it: elements first() to end() are triangles (equal: nothing glows); from end() on
  // there is the alias table, as long; from former() on there is one for each instance of the former list.
  const std::vector<uvec2>& elements() const { return elements_; }
  std::uint32_t first() const { return first_; }
  std::uint32_t end() const { return end_; }
  std::uint32_t former() const { return end_ + (end_ - first_); }
  float power() const { return power_; }         // of all: area times mean radiance, sum of the channels
  bool made_anew() const { return made_anew_; }  // by the last build(): not merely the former list's places

 private:
  // Mean linear colour of an image's texels: of all, and of those alone that glow by their palette index.
  struct Means {
    vec3 all{0.0f}, glowing{0.0f};
  };
  const Means& means(const scene::Assets& assets, std::uint32_t image);
  // An instance of which something glows: all that its part of the list comes from, but for the materials' radiance.
  struct Glowing {
    std::uint32_t instance = 0, mesh = 0, material_base = 0;
    bool colored = false;
    float color = 0;  // sum of the channels
    mat4x3 transform{1.0f};
    scene::PoseBlend pose;
    bool operator==(const Glowing&) const = default;
  };
  static std::vector<Glowing> find_glowing(std::span<const Source> sources, std::span<const float> glow);
  void list_triangles(const scene::Assets& assets, std::span<const Source> sources);
  void add_alias_table();
  const std::vector<float>& areas(const scene::Assets& assets, const Source& source);
  void list_former(std::span<const Source> sources);
  float radiance(const scene::Assets& assets, const shared::GpuMaterial& material, float sky);
  float sky_radiance(const scene::Assets& assets, const scene::Sky& sky);

  std::uint64_t generation_ = 0;
  std::vector<std::optional<Means>> means_;
  std::vector<uvec2> elements_;
  std::uint32_t first_ = 0, end_ = 0;
  float power_ = 0;
  bool made_anew_ = false;
  std::vector<Glowing> glowing_;
  std::vector<float> glow_;         // of the materials: radiance, sum of the channels
  std::vector<std::uint32_t> ids_;  // of the instances, in order
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
