// The denoiser over water in motion, against many samples: what lies in it and what is mirrored in it keep their light.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "render/renderer.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "render/test_water.h"
#include "scene/shapes.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

using SecondSurfaceStatistics = WaterDeviceTest;

bool is_water(const shared::GBufferTexel& g) { return (g.material_metalness & shared::kTexelLiquid) != 0; }

// A basin under a ceiling, both chequered: what lies in the water is dim, what is mirrored in it is bright. The camera
// glides along low over the water.
struct Basin {
  scene::FrameSnapshot snapshot;
  Basin() {
    auto assets = std::make_shared<scene::Assets>();
    const auto add_material = [&](float albedo, float emission) {
      scene::Material m;
      m.base_color = vec3(albedo);
      m.emission_kind = emission > 0 ? scene::EmissionKind::kConstant : scene::EmissionKind::kNone;
      m.emission = vec3(emission);
      assets->materials.push_back(m);
      return static_cast<std::uint32_t>(assets->materials.size() - 1);
    };
    const std::uint32_t dark = add_material(0.1f, 0), light = add_material(0.8f, 0), dim = add_material(0, 0.1f),
                        bright = add_material(0, 4);
    scene::Mesh room;
    const float tile = 40, half = 400;
    for (float x = -half; x < half; x += tile) {
      for (float y = -half; y < half; y += tile) {
        const bool odd = (std::lround((x + y) / tile) & 1) != 0;
        scene::add_quad(room, {x, y, -60}, {tile, 0, 0}, {0, tile, 0}, odd ? light : dark);
        scene::add_quad(room, {x, y, 100}, {0, tile, 0}, {tile, 0, 0}, odd ? dark : light);
      }
    }
    // Lamps that shine up, and under water a dim glow.
    for (float y = -half; y < half; y += 160)
      scene::add_quad(room, {-half, y, 70}, {2 * half, 0, 0}, {0, 30, 0}, bright);
    for (const float side : {-half, half}) {
      const bool left = side < 0;
      scene::add_quad(room, {side, -half, -60}, left ? vec3(0, 2 * half, 0) : vec3(0, 0, 60),
                      left ? vec3(0, 0, 60) : vec3(0, 2 * half, 0), dim);
    }
    scene::finish_mesh(room);
    assets->meshes.push_back(room);
    snapshot.assets = assets;
    snapshot.instances.emplace_back();
    look(snapshot, {-200, 0, 14}, 6, 80);
    add_water(snapshot, 0, half, vec3(0.001f));
  }
  scene::FrameSnapshot at(int frame, const vec3& velocity) const {
    scene::FrameSnapshot s = at_time(snapshot, frame);
    s.camera.position += velocity * static_cast<float>(frame);
    s.prev_camera.position += velocity * static_cast<float>(frame - 1);
    return s;
  }
};

// Root mean square of the error over that of the light, where water is seen.
double error_in_water(const std::vector<vec4>& image, const std::vector<vec4>& reference,
                      const std::vector<shared::GBufferTexel>& gbuffer) {
  double error = 0, light = 0;
  int count = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!is_water(gbuffer[i])) continue;
    error += static_cast<double>(image[i].y - reference[i].y) * (image[i].y - reference[i].y);
    light += static_cast<double>(reference[i].y) * reference[i].y;
    ++count;
  }
  EXPECT_GT(count, 500);
  return std::sqrt(error / light);
}

// With one motion and one irradiance for both it is 0.115.
TEST_F(SecondSurfaceStatistics, BothSurfacesKeepTheirLightInMotion) {
  const Basin basin;
  const int frames = 32;
  const vec3 velocity(0, 3, 0);
  RenderSettings truth = water_settings("pt", 1);
  truth.spp = 512;
  truth.accumulate = 0;
  auto exact = make_renderer(truth, 192, 128);
  exact->render(basin.at(frames, velocity), nullptr, truth);
  const auto reference = exact->read().linear();
  const auto gbuffer = exact->read().gbuffer();
  for (const float light_scale : {1.0f, 0.5f}) {
    RenderSettings s = denoised_water_settings(light_scale);
    s.spp = light_scale < 1 ? 16 : 4;
    auto renderer = make_renderer(s, 192, 128);
    for (int frame = 1; frame <= frames; ++frame) renderer->render(basin.at(frame, velocity), nullptr, s);
    EXPECT_LT(error_in_water(renderer->read().denoised(), reference, gbuffer), 0.09) << light_scale;
  }
}

}  // namespace
}  // namespace fb::render
