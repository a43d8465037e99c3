#include "scene/authored/lamps_apart.h"

#include <gtest/gtest.h>

#include "scene/library/lights.h"
#include "scene/library/test_lit_room.h"

namespace fb::scene {
namespace {

TEST(LampsApart, ThoseInOnePlaceDoNotHideEachOther) {
  const formats::Bsp bsp = test::lit_room().bsp;
  const vec3 place(200, 200, 200);
  const std::vector<EntityLight> lamps{test::lit_lamp(place, 1000), test::lit_lamp(vec3(100, 100, 100), 500),
                                       test::lit_lamp(place, 2000), test::lit_lamp(place + vec3(6, 0, 0), 2000)};
  const std::vector<EntityLight> apart = lamps_apart(bsp, lamps);
  ASSERT_EQ(apart.size(), lamps.size());
  EXPECT_EQ(apart[1].position, lamps[1].position) << "alone";
  EXPECT_EQ(apart[1].radius, lamps[1].radius);
  for (const std::size_t i : {0u, 2u, 3u}) {
    EXPECT_LT(apart[i].radius, lamps[i].radius);
    EXPECT_GT(apart[i].radius, 2.0f) << "no smaller than must be";
    const auto power = [](const EntityLight& l) { return l.power_color.x * l.radius * l.radius; };
    EXPECT_NEAR(power(apart[i]) / power(lamps[i]), 1.0f, 1e-5f);
    for (const std::size_t k : {0u, 2u, 3u}) {
      if (i == k) continue;
      EXPECT_GE(0.3751f * glm::length(apart[i].position - apart[k].position), apart[i].radius);
    }
  }
  EXPECT_EQ(apart[0].position, place) << "the first stays";
  EXPECT_EQ(apart[3].position, lamps[3].position) << "far enough";
}

TEST(LampsApart, NoneIsMovedIntoAWall) {
  const formats::Bsp bsp = test::lit_room().bsp;
  const vec3 corner(9, 200, test::kLitRoom - 9);  // beside a wall and the ceiling
  const std::vector<EntityLight> apart = lamps_apart(bsp, {test::lit_lamp(corner, 1000), test::lit_lamp(corner, 1000)});
  EXPECT_EQ(apart[1].position, corner - vec3(0, 0, 8));
}

}  // namespace
}  // namespace fb::scene
