// What tests of lava and teleporters share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "render/test_device.h"
#include "render/test_water.h"

namespace fb::render {

class LavaTest : public WaterDeviceTest {
 protected:
  // A level quad about the origin.
  static void add_level(scene::FrameSnapshot& snapshot, scene::Assets& assets, float z, float half,
                        std::uint32_t material) {
    scene::Mesh quad;
    scene::add_quad(quad, {-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, material);
    scene::finish_mesh(quad);
    assets.meshes.push_back(quad);
    scene::Instance instance;
    instance.id = scene::kIdEntity + static_cast<std::uint32_t>(assets.meshes.size());
    instance.mesh = static_cast<std::uint32_t>(assets.meshes.size() - 1);
    snapshot.instances.push_back(instance);
  }
  // White, so that it glows by one.
  static scene::Material glowing_liquid(scene::Assets& assets, scene::EmissionKind kind, scene::OpacityFrom from) {
    assets.images.push_back({"white", scene::ImageEncoding::kSrgba, 1, 1, {255, 255, 255, 255}});
    scene::Material m;
    m.frames = {scene::TextureSet{static_cast<std::uint32_t>(assets.images.size() - 1)}};
    m.emission = vec3(1.0f);
    m.emission_kind = kind;
    m.flags = scene::kMaterialLiquid;
    m.opacity_from = from;
    return m;
  }
  static scene::Material constant(const vec3& radiance, const vec3& albedo) {
    scene::Material m;
    m.base_color = albedo;
    m.emission = radiance;
    m.emission_kind = scene::EmissionKind::kConstant;
    return m;
  }
};

}  // namespace fb::render
