// Level water in scenes of tests.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "render/test_device.h"
#include "scene/shapes.h"
#include "scene/snapshot.h"

namespace fb::render {

class WaterDeviceTest : public DeviceTest {
 protected:
  static RenderSettings water_settings(const std::string& estimator, int bounces) {
    RenderSettings s = plain_settings(estimator, bounces);
    s.water = 1;
    return s;
  }
  static RenderSettings denoised_water_settings(float light_scale) {
    RenderSettings s = water_settings("pt", 1);
    s.denoise = 1;
    s.light_scale = light_scale;
    s.accumulate = 0;
    s.local_exposure = 0;
    s.bloom = 0;
    return s;
  }
};

inline constexpr float kIndex = 1.33f;

// A scene of one quad alone.
inline scene::FrameSnapshot one_quad(const scene::Material& material, const vec3& corner, const vec3& u,
                                     const vec3& v) {
  scene::FrameSnapshot snapshot;
  auto assets = std::make_shared<scene::Assets>();
  assets->materials.push_back(material);
  scene::Mesh quad;
  scene::add_quad(quad, corner, u, v, 0);
  scene::finish_mesh(quad);
  assets->meshes.push_back(quad);
  snapshot.assets = assets;
  snapshot.instances.emplace_back();
  return snapshot;
}

// A level surface of water at a height, from edge to edge of `half`; the water is under it.
inline void add_water(scene::FrameSnapshot& snapshot, float z, float half, const vec3& absorption,
                      float scattering = 0.0f) {
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  scene::Material water;
  water.name = "water";
  water.base_color = vec3(0.2f);
  water.emission_kind = scene::EmissionKind::kNone;
  water.flags = scene::kMaterialLiquid | scene::kMaterialDielectric;
  water.absorption = absorption;
  water.scattering = scattering;
  const auto material = static_cast<std::uint32_t>(assets->materials.size());
  assets->materials.push_back(water);
  scene::Mesh surface;
  scene::add_quad(surface, {-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, material);
  scene::finish_mesh(surface);
  assets->meshes.push_back(surface);
  scene::Instance instance;
  instance.id = scene::kIdEntity + 100;
  instance.mesh = static_cast<std::uint32_t>(assets->meshes.size() - 1);
  snapshot.instances.push_back(instance);
  snapshot.assets = assets;
  if (snapshot.camera.position.z < z) snapshot.camera_liquid = material;
}

inline void look(scene::FrameSnapshot& snapshot, const vec3& position, float pitch, float fov) {
  snapshot.camera.position = position;
  snapshot.camera.angles = {pitch, 0, 0};
  snapshot.camera.fov_x = fov;
  snapshot.prev_camera = snapshot.camera;
}

}  // namespace fb::render
