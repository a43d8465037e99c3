#include "scene/authored/authored_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "scene/authored/map_rays.h"
#include "scene/library/test_lit_room.h"
#include "shared/spot.h"

namespace fb::scene {
namespace {

using test::bake;
using test::kLitCeiling;
using test::kLitFloor;
using test::kLitRoom;
using test::lamp_light;
using test::lit_lamp;
using test::lit_map;
using test::lit_room;

// Two lamps of equal intensity to the map's keys; the author saw them `true_factors` as strong.
struct TwoLamps {
  formats::Bsp bsp = lit_room().bsp;
  std::vector<EntityLight> lamps{lit_lamp(vec3(120, 130, 300), 20000), lit_lamp(vec3(400, 380, 200), 20000)};
  std::optional<AuthoredLight> found;

  void find(float first, float second, float noise = 0.0f) {
    Rng rng(7);
    bake(bsp, [&](const vec3& p, const vec3& n) {
      const float light = first * lamp_light(lamps[0], p, n) + second * lamp_light(lamps[1], p, n);
      return light * (1.0f + noise * rng.uniform(-1.0f, 1.0f));
    });
    LitMap map = lit_map(bsp);
    map.lamps = lamps;
    found = find_authored_light(map, Lightmaps(bsp));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->emitters.all[0].lamps, std::vector<std::uint32_t>{0});
    ASSERT_EQ(found->emitters.all[1].lamps, std::vector<std::uint32_t>{1});
  }
  float factor(std::size_t emitter) const { return found->fit.factors[emitter].y; }
};

TEST(AuthoredLightSequences, PowersComeBackFromWhatTheyBaked) {
  TwoLamps room;
  room.find(0.3f, 1.8f);
  EXPECT_NEAR(room.factor(0), 0.3f, 0.03f);
  EXPECT_NEAR(room.factor(1), 1.8f, 0.18f);
  EXPECT_LT(room.found->fit.stops_after, 0.25);
  EXPECT_GT(room.found->fit.stops_before, 0.5);
}

TEST(AuthoredLightSequences, ALampKeepsItsLawOfDistance) {
  formats::Bsp bsp = lit_room().bsp;
  std::vector<EntityLight> lamps{lit_lamp(vec3(120, 130, 300), 20000)};
  const auto stops_after = [&](std::uint32_t law) {
    lamps[0].fall = law;
    lamps[0].fall_scale = 2.0f / 700.0f;
    LitMap map = lit_map(bsp);
    map.lamps = lamps;
    const auto found = find_authored_light(map, Lightmaps(bsp));
    return found ? found->fit.stops_after : 1e9;
  };
  bake(bsp, [&](const vec3& p, const vec3& n) {
    const float scaled = glm::length(lamps[0].position - p) * 2.0f / 700.0f;
    return 0.5f * lamp_light(lamps[0], p, n) * shared::fall_share(shared::kFallLinear, scaled);
  });
  EXPECT_LT(stops_after(shared::kFallLinear), 0.5 * stops_after(shared::kFallSquare));
}

TEST(AuthoredLightSequences, ALampOfAStyleThatNoLuxelHasGivesNothing) {
  formats::Bsp bsp = lit_room().bsp;
  LitMap map = lit_map(bsp);
  map.lamps = {lit_lamp(vec3(120, 130, 300), 20000), lit_lamp(vec3(300, 300, 200), 20000)};
  map.lamps[1].style = 40;
  bake(bsp, [&](const vec3& p, const vec3& n) { return lamp_light(map.lamps[0], p, n); });
  const auto found = find_authored_light(map, Lightmaps(bsp));
  ASSERT_TRUE(found);
  for (std::size_t e = 0; e < 2; ++e) EXPECT_EQ(found->fit.factors[e].y > 0.0f, found->emitters.all[e].style == 0);
  EXPECT_NEAR(found->fit.factors[0].y, 1.0f, 0.1f) << "and takes nothing from the others";
}

TEST(AuthoredLightSequences, WhatADarkeningLightTookIsGivenBack) {
  formats::Bsp bsp = lit_room().bsp;
  const EntityLight lamp = lit_lamp(vec3(120, 130, 300), 20000), dark = lit_lamp(vec3(300, 300, 200), 4000);
  bake(bsp, [&](const vec3& p, const vec3& n) {
    return std::max(0.0f, 1.5f * lamp_light(lamp, p, n) - lamp_light(dark, p, n));
  });
  LitMap map = lit_map(bsp);
  map.lamps = {lamp};
  const auto factor = [&] { return find_authored_light(map, Lightmaps(bsp))->fit.factors[0].y; };
  const float without = factor();
  map.darkening = {dark};
  EXPECT_NEAR(factor(), 1.5f, 0.15f);
  EXPECT_LT(without, 1.3f) << "the lamp alone is thought weaker";
}

TEST(AuthoredLightSequences, NoiseInTheBakeIsEvenedOut) {
  TwoLamps room;
  room.find(0.5f, 1.0f, 0.3f);
  EXPECT_NEAR(room.factor(0), 0.5f, 0.05f);
  EXPECT_NEAR(room.factor(1), 1.0f, 0.1f);
}

TEST(AuthoredLightSequences, ALampThatLitNothingGivesNothing) {
  TwoLamps room;
  room.find(1.0f, 0.0f);
  EXPECT_NEAR(room.factor(0), 1.0f, 0.1f);
  EXPECT_LT(room.factor(1), 0.02f);
}

TEST(AuthoredLightSequences, LampsThatCannotBeToldApartShareWhatTheyBaked) {
  TwoLamps room;
  room.lamps[1].position = room.lamps[0].position + vec3(2, 0, 0);
  room.find(0.5f, 0.5f);
  EXPECT_NEAR(room.factor(0) / room.factor(1), 1.0f, 0.35f);
  EXPECT_NEAR(0.5f * (room.factor(0) + room.factor(1)), 0.5f, 0.05f);
}

// The share of a point's light that comes from the ceiling where that is of radiance 1: Lambert's formula for a
// polygon.
float share_of_ceiling(const vec3& p, const vec3& n) {
  const vec3 corners[] = {
      {0, 0, kLitRoom}, {kLitRoom, 0, kLitRoom}, {kLitRoom, kLitRoom, kLitRoom}, {0, kLitRoom, kLitRoom}};
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const vec3 a = glm::normalize(corners[k] - p), b = glm::normalize(corners[(k + 1) % 4] - p),
               across = glm::cross(a, b);
    if (!(glm::length(across) > 1e-6f)) continue;
    const float angle = std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
    sum += static_cast<double>(angle * glm::dot(n, glm::normalize(across)));
  }
  return static_cast<float>(std::fabs(sum) / (2 * static_cast<double>(kPi)));
}

TEST(AuthoredLightSequences, ASkyAloneIsAsBrightAsItsRoom) {
  formats::Bsp bsp = lit_room(true).bsp;
  LitMap map = lit_map(bsp);
  map.sky = vec3(0.1f);
  const auto lit = [](const vec3& p, const vec3& n) {
    return 0.3f * share_of_ceiling(glm::clamp(p, vec3(1.0f), vec3(kLitRoom - 1.0f)), n);
  };
  bake(bsp, lit);
  const auto found = find_authored_light(map, Lightmaps(bsp));
  ASSERT_TRUE(found);
  const auto sky =
      std::ranges::find(found->emitters.all, EmitterKind::kSky, &Emitter::kind) - found->emitters.all.begin();
  EXPECT_NEAR(found->fit.factors[static_cast<std::size_t>(sky)].x, 3.0f, 0.3f);
}

TEST(AuthoredLight, EachStyleIsFittedToItsOwnLight) {
  formats::Bsp bsp = lit_room().bsp;
  const std::vector<EntityLight> lamps{lit_lamp(vec3(120, 130, 300), 20000), lit_lamp(vec3(400, 380, 200), 20000, 32)};
  bake(
      bsp, [&](const vec3& p, const vec3& n) { return 0.5f * lamp_light(lamps[1], p, n); }, 32);
  LitMap map = lit_map(bsp);
  map.lamps = lamps;
  const auto found = find_authored_light(map, Lightmaps(bsp));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->fit.factors[1].x, 0.5f, 0.05f);
  EXPECT_EQ(found->fit.factors[0].x, 0.0f) << "no luxel has the other's style: it lit nothing";
}

TEST(AuthoredLight, WithoutBakedLightNothingIsFound) {
  formats::Bsp bsp = lit_room().bsp;
  LitMap map = lit_map(bsp);
  map.lamps = {lit_lamp(vec3(256), 20000)};
  EXPECT_FALSE(find_authored_light(map, Lightmaps(bsp)));
  bake(bsp, [](const vec3&, const vec3&) { return 0.0f; });
  EXPECT_FALSE(find_authored_light(map, Lightmaps(bsp))) << "black everywhere says nothing";
}

TEST(AuthoredLightSequences, IsTheSameEachTime) {
  TwoLamps a, b;
  a.find(0.3f, 1.8f);
  b.find(0.3f, 1.8f);
  for (std::size_t e = 0; e < a.found->fit.factors.size(); ++e)
    EXPECT_EQ(a.found->fit.factors[e], b.found->fit.factors[e]);
  EXPECT_EQ(a.found->gains.cells, b.found->gains.cells);
}

TEST(AuthoredLight, ItsThreadEndsWithItsTask) {
  formats::Bsp bsp = lit_room().bsp;
  bake(bsp, [](const vec3&, const vec3&) { return 1.0f; });
  LitMap map = lit_map(bsp);
  map.lamps = {lit_lamp(vec3(256), 20000)};
  const Lightmaps lightmaps(bsp);
  { const AuthoredTask dropped(map, lightmaps); }
  AuthoredTask task(map, lightmaps);
  EXPECT_TRUE(task.take());
}

TEST(AuthoredLightSequences, WhatFallsOffAsNoLampDoesIsLeftToTheGains) {
  TwoLamps room;
  // Brighter by the height than any lamp makes it: 0.05 at the floor, 1.6 at the ceiling.
  bake(room.bsp, [](const vec3& p, const vec3&) { return 0.05f * std::exp2(5.0f * p.z / kLitRoom); });
  LitMap map = lit_map(room.bsp);
  map.lamps = room.lamps;
  const auto found = find_authored_light(map, Lightmaps(room.bsp));
  ASSERT_TRUE(found);
  const GainField& field = found->gains;
  ASSERT_FALSE(field.empty());
  // Along the wall where x is 0, which faces +x: way 0.
  const auto gain = [&](float z) {
    const vec3 at = (vec3(1.0f, 256.0f, z) - field.origin) / field.side;
    const auto cell = (static_cast<std::size_t>(at.z) * field.depth + static_cast<std::size_t>(at.y)) * field.width +
                      static_cast<std::size_t>(at.x);
    return field.cells[cell];
  };
  EXPECT_NE(gain(40.0f), 0u);
  EXPECT_NE(gain(40.0f), gain(470.0f));
}

TEST(MapRays, MeetFacesFromTheirFrontAndEndInSolid) {
  const formats::Bsp bsp = lit_room(true).bsp;
  const MapRays rays(bsp);
  const vec3 middle(256);
  const auto down = rays.first_face(middle, middle - vec3(0, 0, 1000));
  ASSERT_TRUE(down);
  EXPECT_EQ(down->face, kLitFloor);
  EXPECT_NEAR(down->point.z, 0.0f, 1e-3f);
  const auto up = rays.first_face(middle, middle + vec3(10, 20, 1000));
  ASSERT_TRUE(up);
  EXPECT_EQ(up->face, kLitCeiling);
  EXPECT_TRUE(rays.is_sky(up->face));
  EXPECT_FALSE(rays.first_face(middle, middle + vec3(100, 0, 0))) << "it ends in the open";
  EXPECT_FALSE(rays.first_face(vec3(-100, 256, 256), middle)) << "from behind";
  EXPECT_TRUE(rays.is_clear(middle, vec3(10)));
  EXPECT_FALSE(rays.is_clear(middle, vec3(600)));
}

}  // namespace
}  // namespace fb::scene
