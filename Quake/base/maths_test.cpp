#include "base/maths.h"

#include <gtest/gtest.h>

#include "base/rng.h"

namespace fb {
namespace {

void expect_near(const vec3& a, const vec3& b, float tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Maths, AngleVectorsFollowQuake) {
  const AxisVectors ahead = angle_vectors({0, 0, 0});
  expect_near(ahead.forward, {1, 0, 0}, 1e-6f);
  expect_near(ahead.right, {0, -1, 0}, 1e-6f);
  expect_near(ahead.up, {0, 0, 1}, 1e-6f);
  expect_near(angle_vectors({0, 90, 0}).forward, {0, 1, 0}, 1e-6f);
  expect_near(angle_vectors({90, 0, 0}).forward, {0, 0, -1}, 1e-6f);  // positive pitch looks down
  expect_near(angle_vectors({0, 0, 90}).right, {0, 0, -1}, 1e-6f);
}

TEST(Maths, AxesAreOrthonormalAndRightHanded) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const AxisVectors a = angle_vectors({rng.uniform(-90, 90), rng.uniform(0, 360), rng.uniform(-180, 180)});
    EXPECT_NEAR(glm::dot(a.forward, a.right), 0, 1e-5f);
    EXPECT_NEAR(glm::length(a.up), 1, 1e-5f);
    expect_near(glm::cross(a.right, a.forward), a.up, 1e-5f);
  }
}

TEST(Maths, InverseAffineUndoesTheTransform) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const mat4x3 m = entity_transform({rng.uniform(-4000, 4000), rng.uniform(-4000, 4000), 10},
                                      {rng.uniform(-90, 90), rng.uniform(0, 360), 5}, rng.uniform(0.1f, 4));
    const vec3 p{rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-50, 50)};
    expect_near(transform_point(inverse_affine(m), transform_point(m, p)), p, 0.02f);
  }
  EXPECT_EQ(inverse_affine(mat4x3(0.0f)), mat4x3(0.0f));
}

TEST(Maths, LerpAngleTakesTheShortWay) {
  EXPECT_NEAR(lerp_angle(350, 10, 0.5f), 360, 1e-4f);
  EXPECT_NEAR(lerp_angle(10, 350, 0.5f), 0, 1e-4f);
  EXPECT_NEAR(lerp_angle(0, 720, 0.5f), 0, 1e-4f);
}

TEST(Maths, TransformedBoundsHoldTheCorners) {
  const mat4x3 m = entity_transform({1, 2, 3}, {30, 40, 50}, 2);
  Bounds box;
  box.add({-1, -2, -3});
  box.add({4, 5, 6});
  const Bounds moved = transform_bounds(m, box);
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p = transform_point(m, {corner & 1 ? 4 : -1, corner & 2 ? 5 : -2, corner & 4 ? 6 : -3});
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(p[axis], moved.min[axis] - 1e-4f);
      EXPECT_LE(p[axis], moved.max[axis] + 1e-4f);
    }
  }
}

}  // namespace
}  // namespace fb
