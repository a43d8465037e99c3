// shared/sun_disc.h: directions that are drawn within a disc are found to be within it, however small it is.
#include "shared/sun_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "base/rng.h"

namespace fb::shared {
namespace {

// A direction `angle` off `axis`, rounded to floats.
vec3 turned_off(const vec3& axis, double angle, double turn) {
  const glm::dvec3 z = glm::normalize(glm::dvec3(axis));
  const glm::dvec3 x = glm::normalize(glm::cross(z, std::abs(z.x) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 y = glm::cross(z, x);
  return vec3((x * std::cos(turn) + y * std::sin(turn)) * std::sin(angle) + z * std::cos(angle));
}

TEST(SunDisc, ItsEdgeIsWhereItsRadiusIs) {
  Rng rng(3);
  for (const double degrees : {0.05, 0.1, 0.25, 1.0, 10.0, 90.0}) {
    const double radius = degrees * static_cast<double>(kSunDiscPi) / 180, half = std::sin(radius / 2);
    const auto disc = static_cast<float>(2 * half * half);
    EXPECT_NEAR(sun_solid_angle(disc), 2 * M_PI * (1 - std::cos(radius)), 1e-6 * radius * radius) << degrees;
    for (int i = 0; i < 2000; ++i) {
      const vec3 axis = glm::normalize(vec3(rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() + 0.01f));
      const double turn = 2 * M_PI * static_cast<double>(rng.uniform());
      ASSERT_TRUE(within_sun(turned_off(axis, radius * 0.9995, turn), axis, disc)) << degrees;
      ASSERT_FALSE(within_sun(turned_off(axis, radius * 1.0005, turn), axis, disc)) << degrees;
    }
  }
}

}  // namespace
}  // namespace fb::shared
