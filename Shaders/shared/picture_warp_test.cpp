#include "shared/picture_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace fb::shared {
namespace {

// No point is taken from beyond the edges, nor from farther away than two waves are high.
TEST(PictureWarp, StaysWithinThePicture) {
  for (const vec2 size : {vec2(320, 200), vec2(1920, 1080), vec2(64, 480), vec2(1, 1)})
    for (int turn = 0; turn < 16; ++turn)
      for (int i = 0; i <= 64; ++i)
        for (int j = 0; j <= 64; ++j) {
          const vec2 point = size * vec2(static_cast<float>(i), static_cast<float>(j)) / 64.0f;
          const vec2 from = warped_point(point, size, static_cast<float>(turn) * kWarpTurn / 16);
          const float height = kWarpHeight * size.y;
          for (int axis = 0; axis < 2; ++axis) {
            ASSERT_GE(from[axis], 0.0f);
            ASSERT_LE(from[axis], size[axis]);
            ASSERT_LE(std::abs(from[axis] - point[axis]), 2 * height * (1 + 1e-4f)) << size.x << ' ' << point.x;
          }
        }
}

// Of 320 x 200 pixels those of Quake's own: 6 more of each axis, in which sines of 3 move, 128 long.
TEST(PictureWarp, HasTheSizesOfQuakes) {
  const vec2 size(320, 200);
  for (int x = 0; x <= 320; x += 5)
    for (int y = 0; y <= 200; y += 5) {
      const vec2 from = warped_point(vec2(x, y), size, 0.5f);
      EXPECT_NEAR(from.x, (x + 3 + 3 * std::sin(y * 2 * 3.14159265 / 128 + 0.5)) * 320 / 326, 1e-3);
      EXPECT_NEAR(from.y, (y + 3 + 3 * std::sin(x * 2 * 3.14159265 / 128 + 0.5)) * 200 / 206, 1e-3);
    }
}

}  // namespace
}  // namespace fb::shared
