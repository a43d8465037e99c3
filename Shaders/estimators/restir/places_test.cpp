// Places of samples on triangles: there and back, and the Jacobian by differences.
#include "estimators/restir/places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "base/rng.h"

namespace fb::shared {
namespace {

TEST(RestirPlaces, AreWordsOfSixteenBitsASide) {
  for (const std::uint32_t word : {0u, 1u, 0x8000ffffu, 0xffff0000u, 0xffffffffu})
    EXPECT_EQ(packed_place(unit_place(word)), word);
  EXPECT_EQ(packed_place(vec2(-1.0f, 2.0f)), 0xffffu);
}

TEST(RestirPlaces, OfATriangleComeBack) {
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t word = rng.next();
    const vec2 u = unit_place(word), bary = triangle_place(u);
    EXPECT_TRUE(bary.x >= 0 && bary.y >= 0 && bary.x + bary.y <= 1) << word;
    const vec2 back = unit_of_triangle(bary);
    EXPECT_NEAR(back.x, u.x, 1e-6) << word;
    EXPECT_NEAR(back.y, u.y, 1e-6) << word;
  }
  EXPECT_EQ(packed_place(unit_of_triangle(vec2(0.0f, 0.0f))), 0u) << "vertex 0";
}

// Of the weights by the place: 1/2 everywhere, the area of the triangle of weights. So shifts have Jacobian 1.
TEST(RestirPlaces, AreEvenOverTheTriangle) {
  Rng rng(6);
  const float h = 1.0f / 256;
  for (int i = 0; i < 1000; ++i) {
    const vec2 u(0.05f + 0.9f * static_cast<float>(rng.next() >> 8u) / 16777216.0f,
                 0.05f + 0.9f * static_cast<float>(rng.next() >> 8u) / 16777216.0f);
    const vec2 x = (triangle_place(u + vec2(h, 0)) - triangle_place(u - vec2(h, 0))) / (2 * h);
    const vec2 y = (triangle_place(u + vec2(0, h)) - triangle_place(u - vec2(0, h))) / (2 * h);
    EXPECT_NEAR(std::abs(x.x * y.y - x.y * y.x), 0.5, 0.5 * h * h / (u.x * u.x) + 1e-4) << u.x << ' ' << u.y;
  }
}

}  // namespace
}  // namespace fb::shared
