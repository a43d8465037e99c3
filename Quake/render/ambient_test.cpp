// Even light (FrameSnapshot::ambient) in the denoised picture; exactly what it adds: ambient_statistics_test.cpp.
#include <gtest/gtest.h>

#include "render/renderer.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using AmbientTest = DeviceTest;

TEST_F(AmbientTest, TheDenoiserKeepsItAndAChangeStartsAnew) {
  const float albedo = 0.6f;
  RenderSettings s = plain_settings("pt", 2);
  s.deterministic = 1;
  s.denoise = 1;
  scene::FrameSnapshot snapshot = scene::furnace(albedo, 0.0f);
  auto renderer = make_renderer(s, 24, 16);
  for (const float light : {0.5f, 0.25f, 0.0f}) {
    snapshot.ambient = vec3(light);
    for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
    EXPECT_EQ(renderer->accumulated_frames(), 3u);
    for (const vec4& p : renderer->read().denoised()) ASSERT_NEAR(p.x, albedo * light, 1e-3f * light);
  }
}

}  // namespace
}  // namespace fb::render
