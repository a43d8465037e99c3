// What a map's baked light asks of the picture: gains at the first vertex, skies that shine unseen, spots.
#include <gtest/gtest.h>

#include <cmath>

#include "render/renderer.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"
#include "shared/denoise.h"
#include "shared/gain_field.h"

namespace fb::render {
namespace {

using AuthoredTest = DeviceTest;

// One cell all around, of that factor.
void add_gain(scene::FrameSnapshot& snapshot, const vec3& gain) {
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  scene::Image field{
      "gain field", scene::ImageEncoding::kWords, 2 * 2 * 2 * static_cast<int>(shared::kGainWays), 1, {}};
  const std::uint32_t word = shared::pack_rgb9e5(gain, 0.5f);
  for (int i = 0; i < field.width; ++i)
    for (int byte = 0; byte < 4; ++byte) field.texels.push_back(static_cast<std::uint8_t>(word >> (8 * byte)));
  assets->images.push_back(std::move(field));
  snapshot.gains = {static_cast<std::uint32_t>(assets->images.size() - 1), vec3(-1000.0f), 1000.0f, 2, 2, 2};
  snapshot.assets = std::move(assets);
  snapshot.authored = true;
}

TEST_F(AuthoredTest, GainsAreAFactorOnAllThatTheFirstVertexReflects) {
  const float albedo = 0.5f, emission = 0.25f;
  RenderSettings s = plain_settings("pt", 2);
  s.deterministic = 1;
  scene::FrameSnapshot snapshot = scene::furnace(albedo, emission);
  auto renderer = make_renderer(s, 24, 16);
  renderer->render(snapshot, nullptr, s);
  const auto plain = renderer->read().linear();
  add_gain(snapshot, vec3(0.5f, 1.0f, 1.5f));
  renderer->render(snapshot, nullptr, s);
  const auto gained = renderer->read().linear();
  ASSERT_EQ(plain.size(), gained.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const vec3 reflected = vec3(plain[i]) - emission;
    EXPECT_NEAR(gained[i].x - emission, 0.5f * reflected.x, 4e-3f);
    EXPECT_NEAR(gained[i].y - emission, reflected.y, 4e-3f);
    EXPECT_NEAR(gained[i].z - emission, 1.5f * reflected.z, 4e-3f);
  }
  snapshot.authored = false;
  renderer->render(snapshot, nullptr, s);
  EXPECT_EQ(renderer->read().linear(), plain);
}

TEST_F(AuthoredTest, ASkyMayShineUnseen) {
  RenderSettings s = plain_settings("pt", 1);
  scene::FrameSnapshot snapshot = scene::furnace(0.5f, 0.0f);
  snapshot.instances.clear();  // nothing but the sky
  snapshot.sky.mode = scene::SkyMode::kConstant;
  snapshot.sky.color = vec3(0.125f);
  snapshot.sky.even = vec3(3.0f);
  snapshot.sky.beyond_everything = true;
  auto renderer = make_renderer(s, 24, 16);
  renderer->render(snapshot, nullptr, s);
  for (const vec4& p : renderer->read().linear()) ASSERT_NEAR(p.x, 0.125f, 1e-6f);
}

}  // namespace
}  // namespace fb::render
