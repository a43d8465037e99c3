// Light entities, surface lights, suns and even light against the formulas of lights.h.
#include "scene/library/lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/library/asset_builder.h"
#include "scene/library/light_sources.h"
#include "scene/library/sky_images.h"
#include "scene/library/test_maps.h"
#include "shared/spot.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

std::vector<world::Entity> entities_of(std::string_view text) {
  auto parsed = world::parse_entity_lump(text, "test");
  EXPECT_TRUE(parsed.ok());
  return *parsed;
}
std::vector<EntityLight> lights_of(std::string_view text) {
  return entity_lights(entities_of(text), test::MapBuilder().bsp);
}
// irradiance / pi at a distance, for a surface that faces the sphere.
float brightness(const EntityLight& light, float distance) {
  return light.power_color.x * light.radius * light.radius / (distance * distance);
}

TEST(Lights, MatchQuakeAtTheirDistance) {
  const auto lights = lights_of(
      "{classname light origin \"0 0 0\"}"
      "{classname light_torch light 200 wait 2}"
      "{classname light light 100 delay 2}"
      "{classname light light 100 delay 1 wait 0.5}"
      "{classname light light 100 delay 5}");
  ASSERT_EQ(lights.size(), 5u);
  // A value of 128 is brightness 1.
  EXPECT_NEAR(brightness(lights[0], 150.0f), 150.0f / 128.0f, 1e-4f);
  EXPECT_NEAR(brightness(lights[1], 50.0f), 100.0f / 128.0f, 1e-4f);
  EXPECT_NEAR(brightness(lights[2], 64.0f), 100.0f * 4.0f / 128.0f, 1e-3f);
  EXPECT_NEAR(brightness(lights[3], 256.0f), 100.0f / 128.0f, 1e-4f);
  EXPECT_NEAR(brightness(lights[4], 128.0f), 25.0f / 128.0f, 1e-4f);
  EXPECT_FLOAT_EQ(lights[0].radius, kLightRadius);
}

TEST(Lights, TheirOwnLawsAreTheTools) {
  const float value = 200.0f, wait = 2.0f;
  const auto shown = [&](int delay, float d) {
    EntityLight light{};
    set_fall(light, value, wait, delay);
    return light_strength(value, wait, delay) / (d * d) * shared::fall_share(light.fall, d * light.fall_scale);
  };
  for (const float d : {5.0f, 20.0f, 64.0f, 90.0f, 130.0f}) {
    EXPECT_NEAR(shown(0, d), std::max(value - wait * d, 0.0f) / 128.0f, 1e-4f) << d;
    EXPECT_NEAR(shown(1, d), value / (wait * d), 1e-3f) << d;
    EXPECT_NEAR(shown(2, d), value * 128.0f / (wait * d * wait * d), 1e-2f) << d;
    EXPECT_NEAR(shown(3, d), value / 128.0f, 1e-4f) << d;
    EXPECT_NEAR(shown(5, d), value * 128.0f / ((wait * d + 128.0f) * (wait * d + 128.0f)), 1e-4f) << d;
  }
}

TEST(Lights, NoLightIsNone) {
  EXPECT_TRUE(lights_of("{classname light light -100}{classname light delay 4}{classname info_light light 9}"
                        "{classname light _surface wall}{classname light _sun 1}{classname light _color \"0 0 0\"}")
                  .empty());
  EXPECT_TRUE(lights_of("{classname light origin \"1e30 0 0\"}").empty());
  for (int delay = 0; delay < 6; ++delay) EXPECT_TRUE(std::isfinite(light_strength(1e30f, 1e-30f, delay)));
  EXPECT_EQ(light_strength(std::nanf(""), 1.0f, 0), 0.0f);
  EXPECT_EQ(light_strength(100.0f, 0.0f, 0), light_strength(100.0f, 1.0f, 0)) << "wait 0 is not a division";
}

TEST(Lights, ColorsSpotsAndStyles) {
  const auto lights = lights_of(
      "{classname light _color \"255 0 127.5\" style 5}{classname light color \"1 0 0.5\"}"
      "{classname light mangle \"0 -90 0\" angle 60}{classname light style 99}{classname light angle 180}"
      "{classname light _light \"0 255 0 300\"}");
  ASSERT_EQ(lights.size(), 6u);
  EXPECT_EQ(lights[0].power_color, lights[1].power_color);
  EXPECT_EQ(lights[0].power_color.y, 0.0f);
  EXPECT_NEAR(lights[0].power_color.z / lights[0].power_color.x, 0.2140f, 1e-3f) << "sRGB 0.5";
  EXPECT_EQ(lights[0].style, 5);
  EXPECT_EQ(lights[3].style, 63);
  EXPECT_EQ(lights[2].power_color, lights[3].power_color) << "a spot is as bright within its cone";
  EXPECT_NEAR(lights[2].axis.z, -1.0f, 1e-6f);
  EXPECT_NEAR(lights[2].least_cosine, std::cos(radians(30.0f)), 1e-6f) << "a cone of 60 degrees";
  EXPECT_EQ(lights[2].full_cosine, lights[2].least_cosine) << "with a hard edge";
  EXPECT_EQ(lights[3].axis, vec3(0)) << "and no other has an axis";
  EXPECT_EQ(lights[4].power_color, lights[3].power_color) << "angle alone makes no spot";
  EXPECT_EQ(lights[5].power_color, vec3(0, lights[3].power_color.x, 0));
}

TEST(Lights, SpotsShineAtTheirTargetsAndFade) {
  const auto lights = lights_of(
      "{classname light origin \"0 0 100\" target t _softangle 20}{classname info_null targetname t origin \"100 0 "
      "100\"}"
      "{classname light target nobody}");
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_NEAR(lights[0].axis.x, 1.0f, 1e-6f);
  EXPECT_NEAR(lights[0].least_cosine, std::cos(radians(20.0f)), 1e-6f) << "40 degrees where nothing is said";
  EXPECT_NEAR(lights[0].full_cosine, std::cos(radians(10.0f)), 1e-6f);
  EXPECT_EQ(lights[1].axis, vec3(0)) << "a target that is not there";
}

TEST(Lights, KeepClearOfWalls) {
  // Solid below z = 0, and a wall of 1 unit between x = 20 and 21.
  formats::Bsp bsp = test::MapBuilder().bsp;
  bsp.planes = {{vec3(0, 0, 1), 0.0f, 2}, {vec3(1, 0, 0), 20.0f, 0}, {vec3(1, 0, 0), 21.0f, 0}};
  formats::BspNode a{}, b{}, c{};
  a.plane = 0, a.children = {1, ~0};
  b.plane = 1, b.children = {2, ~1};
  c.plane = 2, c.children = {~1, ~0};
  bsp.nodes = {a, b, c};
  bsp.models[0].head_nodes[0] = 0;
  const auto lights = entity_lights(entities_of("{classname light origin \"0 0 1\"}{classname light origin \"0 0 -5\"}"
                                                "{classname light origin \"0 0 -99\"}"
                                                "{classname light origin \"17 0 50\"}"),
                                    bsp);
  ASSERT_EQ(lights.size(), 3u) << "the one deep in solid is dropped";
  for (const EntityLight& light : lights) {
    EXPECT_GT(light.position.z, 7.9f);
    EXPECT_NEAR(light.radius, kLightRadius, 0.2f);
    EXPECT_FALSE(world::trace_line(bsp, light.position, light.position - vec3(0, 0, light.radius * 0.99f)).hit);
  }
  EXPECT_LT(lights[2].position.x, 12.2f);
  EXPECT_NEAR(brightness(lights[0], 150.0f), 150.0f / 128.0f, 1e-3f) << "whatever the radius";
}

TEST(Lights, SurfaceLightsHaveThePowerOfTheirSpheres) {
  test::MapBuilder map;
  map.add_square(0, 0, 0, 128, map.add_texture(test::texture("Panel")));
  const auto lights = surface_lights(
      entities_of("{classname light _surface panel light 128 delay 2 style 5}{classname light _surface nothing}"
                  "{classname light _surface panel targetname t spawnflags 1}"),
      map.bsp);
  ASSERT_EQ(lights.size(), 1u);
  const vec3 radiance = lights.at("panel").radiance;
  EXPECT_EQ(lights.at("panel").style, 5);
  // Far in front: radiance * area / d^2 = pi * brightness; delay 2 is exact at all distances.
  const float d = 1000.0f;
  EXPECT_NEAR(radiance.x * 128 * 128 / (d * d), kPi * light_strength(128, 1, 2) / (d * d), 1e-5f);
}

TEST(Lights, SurfaceLightsThatBeginOffFollowTheirSwitch) {
  test::MapBuilder map;
  map.add_square(0, 0, 0, 128, map.add_texture(test::texture("panel")));
  const std::string off = "{classname light _surface panel targetname t spawnflags 1 style 33}";
  const auto of = [&](const std::string& text) { return surface_lights(entities_of(text), map.bsp); };
  ASSERT_EQ(of(off).size(), 1u);
  EXPECT_TRUE(of(off).at("panel").switched);
  EXPECT_EQ(of(off).at("panel").style, 33);
  EXPECT_TRUE(of("{classname light _surface panel targetname t spawnflags 1 style 3}").empty())
      << "nothing in the game switches such a style";
  const std::string on = "{classname light _surface panel light 100}";
  for (const std::string& both : {on + off, off + on}) {
    EXPECT_FALSE(of(both).at("panel").switched);
    EXPECT_EQ(of(both).at("panel").radiance, of(on).at("panel").radiance);
  }
  EXPECT_FALSE(of("{classname light _surface panel targetname t style 33}").at("panel").switched) << "it begins on";
}

TEST(Lights, FalloffAndTheWorldsFactors) {
  const auto strength = [](const EntityLight& light) { return light.power_color.x * light.radius * light.radius; };
  const auto lights = lights_of(
      "{classname worldspawn _dist 2 _range 1}"
      "{classname light light 200}{classname light light 200 _falloff 400}{classname light light 200 delay 2}");
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_NEAR(strength(lights[0]), 2.0f * light_strength(200, 2, 0), 1e-1f);
  EXPECT_NEAR(strength(lights[1]), 2.0f * light_strength(200, 0.5f, 0), 1e-1f) << "it ends where _falloff says";
  EXPECT_NEAR(lights[1].fall_scale, 2.0f / 400.0f, 1e-6f);
  EXPECT_NEAR(strength(lights[2]), 2.0f * light_strength(200, 2, 2), 1e-1f);
}

TEST(Lights, AnglesThatCountForLittleMakeLightsStronger) {
  const auto strength = [](const std::string& key) {
    const auto lights = lights_of("{classname light light 200 " + key + "}");
    return lights.at(0).power_color.x / lights_of("{classname light light 200}").at(0).power_color.x;
  };
  EXPECT_NEAR(strength("_anglescale 0"), 4.0f / 3.0f, 1e-4f) << "the mean over all ways is 1, and 0.75 at 0.5";
  EXPECT_NEAR(strength("_anglesense 0.25"), 0.875f / 0.75f, 1e-4f);
  EXPECT_NEAR(strength("_anglescale -7"), 4.0f / 3.0f, 1e-4f);
  EXPECT_EQ(strength("_anglescale 0.5"), 1.0f);
  EXPECT_EQ(strength("_anglescale 1"), 1.0f) << "Lambert's law, as here";
  const auto sun = [](const std::string& key) {
    return suns(entities_of("{classname worldspawn _sunlight 100 " + key + "}")).at(0).irradiance.x;
  };
  EXPECT_NEAR(sun("_anglescale 0") / sun(""), 4.0f / 3.0f, 1e-4f);
}

TEST(Lights, WhatStandsForASkyOrForOtherEnginesIsNoLamp) {
  EXPECT_TRUE(lights_of("{classname light _sunlight2 1 light 99}{classname light _sunlight3 1}"
                        "{classname light _nostaticlight 1}{classname light_globe _sun 1}")
                  .empty());
}

TEST(Suns, DomesAboveAndBelowHaveTheirColours) {
  const auto dome = [](std::string_view text, bool below = false) { return dome_radiance(entities_of(text), below); };
  EXPECT_EQ(dome("{classname worldspawn}", true), vec3(0));
  EXPECT_EQ(dome("{classname worldspawn _sunlight2 64}"), vec3(0.5f));
  for (const char* key : {"_sunlight2_color", "_sunlight_color2", "sunlight2_color"})
    EXPECT_EQ(dome(std::string("{classname worldspawn sunlight2 64 ") + key + " \"255 0 0\"}"), vec3(0.5f, 0, 0))
        << key;
  const char* both = "{classname worldspawn _sunlight2 64 _sunlight3 128 _sunlight3_color \"0 0 1\"}";
  EXPECT_EQ(dome(both), vec3(0.5f)) << "no sky is below";
  EXPECT_EQ(dome(both, true), vec3(0.5f, 0.5f, 1.0f));
  EXPECT_EQ(dome("{classname worldspawn}{classname light _sunlight2 1 light 128 _color \"0 1 0\"}"), vec3(0, 1, 0));
}

TEST(Suns, KeysOfTheWorld) {
  const auto one =
      suns(entities_of("{classname worldspawn _sunlight 256 _sun_mangle \"90 -45 0\" _sunlight_color "
                       "\"255 0 0\" _sunlight_penumbra 6}"));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].irradiance.x, 2.0f * kPi, 1e-4f);
  EXPECT_EQ(one[0].irradiance.y, 0.0f);
  EXPECT_FLOAT_EQ(one[0].angular_radius, 3.0f);
  // Light goes north and down; the sun stands in the south, half up.
  EXPECT_NEAR(glm::length(one[0].direction - glm::normalize(vec3(0, -1, 1))), 0.0f, 1e-5f);

  const auto bare = suns(entities_of("{classname worldspawn sunlight 128 sun_mangle \"0 -90\" _sun2 10}"));
  ASSERT_EQ(bare.size(), 2u);
  EXPECT_NEAR(bare[0].direction.z, 1.0f, 1e-5f);
  EXPECT_NEAR(bare[1].direction.z, 1.0f, 1e-5f) << "straight down without a mangle";
  EXPECT_TRUE(suns(entities_of("{classname worldspawn}")).empty());
  EXPECT_TRUE(suns({}).empty());

  const auto entity =
      suns(entities_of("{classname worldspawn}{classname light _sun 1 light 128 target t origin "
                       "\"0 0 100\"}{targetname t origin \"100 0 0\"}"));
  ASSERT_EQ(entity.size(), 1u);
  EXPECT_NEAR(glm::length(entity[0].direction - glm::normalize(vec3(-1, 0, 1))), 0.0f, 1e-5f);
}

TEST(Lights, WhatDarkensIsKnownApart) {
  const auto dark = darkening_lights(entities_of("{classname light light -200 delay 2}{classname light light 100}"),
                                     test::MapBuilder().bsp);
  ASSERT_EQ(dark.size(), 1u);
  EXPECT_NEAR(brightness(dark[0], 128.0f), 200.0f / 128.0f, 1e-4f);
}

TEST(Ambient, BrushEntitiesHaveTheirOwn) {
  const auto even = even_light_of_submodels(
      entities_of("{classname worldspawn _minlight 99}{classname func_wall model *2 _minlight 32}"
                  "{classname func_door model *1}{classname func_door model *3 minlight 64 _mincolor \"0 1 0\"}"),
      4);
  ASSERT_EQ(even.size(), 2u);
  EXPECT_NEAR(even.at(2).x, linear_from_srgb(32.0f / 256.0f), 1e-6f);
  EXPECT_EQ(even.at(3).x, 0.0f);
  EXPECT_NEAR(even.at(3).y, linear_from_srgb(64.0f / 256.0f), 1e-6f);
}

TEST(Ambient, KeysOfTheWorld) {
  const auto radiance = [](std::string_view text) { return ambient_radiance(entities_of(text)); };
  const auto shown = [](float value) { return vec3(linear_from_srgb(value / 256.0f)); };
  EXPECT_EQ(radiance("{classname worldspawn _minlight 256}"), vec3(1.0f)) << "as painted";
  EXPECT_EQ(radiance("{classname worldspawn _minlight 32}"), shown(32));
  EXPECT_EQ(radiance("{classname worldspawn light 64}"), shown(64));
  EXPECT_EQ(radiance("{classname worldspawn light 64 _minlight 32}"), shown(32));
  EXPECT_NEAR(radiance("{classname worldspawn _minlight 20}").x, 0.006957f, 1e-6f);
  for (const char* key : {"_minlight_color", "minlight_color", "_mincolor"}) {
    const vec3 colored = radiance(std::string("{classname worldspawn minlight 64 ") + key + " \"127.5 255 0\"}");
    EXPECT_NEAR(glm::length(colored - vec3(shown(32).x, shown(64).y, 0.0f)), 0.0f, 1e-6f) << key;
  }
  for (const char* none :
       {"{classname worldspawn}", "{classname worldspawn _minlight -20}", "{classname worldspawn _minlight 0 light 0}",
        "{classname worldspawn light bright}", "{classname worldspawn}{classname light light 300 _minlight 30}"})
    EXPECT_EQ(radiance(none), vec3(0.0f)) << none;
  EXPECT_EQ(ambient_radiance({}), vec3(0.0f));
  EXPECT_EQ(radiance("{classname worldspawn _minlight 1e38}"), shown(510)) << "no lightmap holds more";
}

TEST(Sky, LayersOfItsTexture) {
  test::TestFiles files;
  files.add_palette();
  AssetBuilder builder(files.loader());
  test::MapBuilder map;
  formats::BspTexture sky = test::texture("sky1", 0, 8, 4);
  for (std::size_t y = 0; y < 4; ++y)
    for (std::size_t x = 0; x < 8; ++x)
      sky.indices[y * 8 + x] = static_cast<std::uint8_t>(x < 4 ? (x % 2 == 0 ? 0 : 50) : 100);
  map.add_texture(sky);
  const Sky layers = make_layered_sky(builder, map.bsp, vec3(0.0f));
  EXPECT_EQ(layers.mode, SkyMode::kLayers);
  EXPECT_EQ(layers.color, vec3(1.0f));
  const Image &solid = builder.assets().images[layers.solid], &alpha = builder.assets().images[layers.alpha];
  EXPECT_EQ(solid.width, 4);
  EXPECT_EQ(solid.texels[5], 100);
  EXPECT_EQ(alpha.texels[3], 0) << "index 0 is a hole";
  EXPECT_EQ(alpha.texels[7], 255);
  EXPECT_EQ(alpha.texels[4], 50);
  const float mean = 0.5f * (linear_from_srgb(std::uint8_t{50}) + linear_from_srgb(std::uint8_t{100}));
  EXPECT_NEAR(make_layered_sky(builder, map.bsp, vec3(2.0f * mean)).color.x, 2.0f, 1e-3f);
  EXPECT_EQ(make_layered_sky(builder, map.bsp, vec3(99.0f)).color.x, kMaxSkyFactor);
  const vec3 red = make_layered_sky(builder, map.bsp, vec3(2.0f * mean, 0.0f, 0.0f)).color;
  EXPECT_NEAR(red.x, 2.0f, 1e-3f);
  EXPECT_EQ(red.y, 1.0f) << "never darker than painted";
  EXPECT_EQ(make_layered_sky(builder, test::MapBuilder().bsp, vec3(1.0f)).mode, SkyMode::kBlack);

  // Quake 64's: 32 by 64, the near layer above, without holes and half clear.
  test::MapBuilder quake64;
  quake64.bsp.version = formats::BspVersion::kQuake64;
  formats::BspTexture stacked = test::texture("sky64", 0, 32, 64);
  std::fill(stacked.indices.begin() + 32 * 32, stacked.indices.end(), std::uint8_t{7});
  quake64.add_texture(stacked);
  const Sky half = make_layered_sky(builder, quake64.bsp, vec3(0.0f));
  const Image& near_layer = builder.assets().images[half.alpha];
  const Image& far_layer = builder.assets().images[half.solid];
  EXPECT_EQ(far_layer.width, 32);
  EXPECT_EQ(far_layer.height, 32);
  EXPECT_EQ(far_layer.texels[0], 7);
  EXPECT_EQ(near_layer.texels[3], 128);
}

TEST(Sky, Boxes) {
  test::TestFiles files;
  files.add_palette();
  for (const char* side : {"rt", "bk", "lf", "ft", "up", "dn"})
    files.add_tga(std::string("gfx/env/space_") + side + ".tga", 2, 2, {1, 2, 3});
  AssetBuilder builder(files.loader());
  Sky fallback;
  fallback.suns.resize(1);
  const Sky box = make_box_sky(builder, "space", fallback);
  EXPECT_EQ(box.mode, SkyMode::kBox);
  EXPECT_EQ(box.suns.size(), 1u);
  EXPECT_EQ(builder.assets().images[box.box[5]].name, "gfx/env/space_dn.tga");
  EXPECT_EQ(make_box_sky(builder, "nowhere", fallback).mode, SkyMode::kBlack);
}

}  // namespace
}  // namespace fb::scene
