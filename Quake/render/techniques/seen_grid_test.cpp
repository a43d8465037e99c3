// The memory of what shadow rays reached: it is forgotten and given back, and its counters hold every frame.
#include <gtest/gtest.h>

#include <cmath>

#include "render/techniques/seen_grid.h"
#include "render/techniques/test_seen_grid.h"
#include "render/test_image.h"
#include "shared/seen_grid.h"

namespace fb::render {
namespace {

TEST_F(SeenGridTest, ItIsForgottenAndGivenBack) {
  RenderSettings s = looking(1);
  const scene::FrameSnapshot scene = room_without_view();
  auto renderer = make_renderer(s, 64, 48);
  renderer->render(scene, nullptr, s);
  const std::uint64_t fresh = image_hash(*renderer);
  EXPECT_GT(renderer->learnt_bytes(), 0u);
  for (int i = 0; i < 4; ++i) renderer->render(scene, nullptr, s);
  EXPECT_NE(image_hash(*renderer), fresh) << "what was learnt shows";
  renderer->reset_learning();
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(image_hash(*renderer), fresh);
  s.estimator = "pt";
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(renderer->learnt_bytes(), 0u);
}

// However many rays a frame sends: all of them in one cell still fit its counters.
TEST(SeenStride, NoCounterOverflows) {
  for (const uvec2 size : {uvec2(1, 1), uvec2(320, 180), uvec2(1920, 1080), uvec2(7680, 4320)}) {
    for (const int spp : {1, 4, 4096}) {
      for (const bool medium : {false, true}) {
        RenderSettings s;
        s.spp = spp;
        s.bounces = 3;
        s.medium_bounces = 8;
        s.denoise = 1;
        const std::uint64_t stride = seen_stride(size, s, medium);
        EXPECT_EQ(stride & (stride - 1), 0u);
        const int vertices = s.bounces + (medium ? s.medium_bounces : 0);
        const double rays = double(size.x) * size.y * spp * vertices * s.first_spp / static_cast<double>(stride);
        EXPECT_LT(rays + 8 * std::sqrt(rays), shared::kSeenRay) << size.x << "x" << size.y << ", " << spp << medium;
      }
    }
  }
}

}  // namespace
}  // namespace fb::render
