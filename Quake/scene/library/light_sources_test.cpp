// What counts as a source of a map's light, and what a map without one gets: maps made in code, loaded from files.
#include "scene/library/light_sources.h"

#include <gtest/gtest.h>

#include "formats/test_bsp.h"
#include "scene/library/library.h"
#include "scene/library/test_maps.h"

namespace fb::scene {
namespace {

constexpr std::uint8_t kDull = 10, kGlowing = 230;  // palette indices

struct LightSources : testing::Test {
  LightSources() { files.add_palette(); }
  // A dull floor; the same entities and textures every time but for what is said.
  test::MapBuilder floor(const std::string& name = "floor", std::uint8_t index = kDull) {
    test::MapBuilder map;
    map.add_square(0, 0, 0, 64, map.add_texture(test::texture(name, index)));
    return map;
  }
  // The even light of a map in the game.
  AmbientLight ambient(test::MapBuilder map, const std::string& entities = "") {
    map.bsp.entities = "{\"classname\" \"worldspawn\"}" + entities;
    return ambient_of(map);
  }
  AmbientLight ambient_of(const test::MapBuilder& map) {
    files.files["maps/a.bsp"] = formats::testing::write_bsp(map.bsp);
    ModelLibrary library(files.loader());
    const Status status = library.load_map("maps/a.bsp");
    EXPECT_TRUE(status.ok()) << status.error().message;
    const AmbientLight found = library.map_ambient();
    library.clear();
    EXPECT_EQ(library.map_ambient().radiance, vec3(0.0f)) << "forgotten with the map";
    return found;
  }
  void expect_dark(const AmbientLight& light) {
    EXPECT_EQ(light.radiance, vec3(1.0f)) << "textures as they were painted";
    EXPECT_TRUE(light.instead);
  }
  void expect_lit(const AmbientLight& light) {
    EXPECT_EQ(light.radiance, vec3(0.0f));
    EXPECT_FALSE(light.instead);
  }
  test::TestFiles files;
};

TEST_F(LightSources, Lamps) {
  expect_dark(ambient(floor()));
  expect_lit(ambient(floor(), "{\"classname\" \"light\" \"light\" \"1\"}"));
  expect_dark(ambient(floor(), "{\"classname\" \"light\" \"light\" \"-1\"}"));
  expect_lit(ambient(floor(), "{\"classname\" \"light\" \"_surface\" \"floor\"}"));
  expect_dark(ambient(floor(), "{\"classname\" \"light\" \"_surface\" \"ceiling\"}"));
}

TEST_F(LightSources, TexelsThatGlow) {
  expect_lit(ambient(floor("floor", kGlowing)));
  test::MapBuilder one_texel = floor();
  one_texel.bsp.textures[0].indices[7] = kGlowing;
  expect_lit(ambient(one_texel));
  expect_lit(ambient(floor("*lava1")));
  expect_lit(ambient(floor("*teleport")));
  expect_dark(ambient(floor("*water1")));
  test::MapBuilder unused = floor();
  unused.add_texture(test::texture("lamp", kGlowing));
  expect_dark(ambient(unused));
}

TEST_F(LightSources, ImagesOfTextures) {
  files.add_tga("textures/floor.tga", 4, 4, {50, 50, 50});
  expect_dark(ambient(floor()));
  files.add_tga("textures/floor_luma.tga", 4, 4, {0, 0, 0});
  expect_dark(ambient(floor()));
  files.add_tga("textures/floor_luma.tga", 4, 4, {0, 9, 0});
  expect_lit(ambient(floor()));
}

TEST_F(LightSources, Skies) {
  const auto sky = [&](std::uint8_t index) {
    test::MapBuilder map;
    map.add_square(0, 0, 0, 64, map.add_texture(test::texture("sky1", index, 32, 16)));
    return map;
  };
  expect_lit(ambient(sky(kDull)));
  expect_dark(ambient(sky(0)));
  test::MapBuilder night = sky(0);
  night.bsp.entities = "{\"classname\" \"worldspawn\" \"_sunlight\" \"100\"}";
  expect_lit(ambient_of(night));
  night.bsp.entities = "{\"classname\" \"worldspawn\" \"sky\" \"stars\"}";
  expect_lit(ambient_of(night));
  test::MapBuilder indoors = floor();
  indoors.bsp.entities = "{\"classname\" \"worldspawn\" \"_sunlight\" \"100\" \"sky\" \"stars\"}";
  expect_dark(ambient_of(indoors));
}

TEST_F(LightSources, ModelsThatAreShown) {
  test::MapBuilder map = floor();
  map.add_square(0, 0, 32, 64, map.add_texture(test::texture("lamp", kGlowing)));
  map.bsp.models[0].face_count = 1;
  map.bsp.models.push_back(map.bsp.models[0]);
  map.bsp.models[1].first_face = 1;
  expect_dark(ambient(map));
  expect_dark(ambient(map, "{\"classname\" \"trigger_once\" \"model\" \"*1\"}"));
  expect_dark(
      ambient(map, "{\"classname\" \"func_door\" \"model\" \"*2\"}{\"model\" \"*\"}{\"model\" \"progs/lamp.mdl\"}"));
  expect_lit(ambient(map, "{\"classname\" \"func_door\" \"model\" \"*1\"}"));
}

TEST_F(LightSources, WhatTheMapAsksForCounts) {
  for (const std::uint8_t index : {kDull, kGlowing}) {
    test::MapBuilder map = floor("floor", index);
    map.bsp.entities = "{\"classname\" \"worldspawn\" \"_minlight\" \"256\" \"_mincolor\" \"1 0 0\"}";
    const AmbientLight light = ambient_of(map);
    EXPECT_EQ(light.radiance, vec3(1, 0, 0));
    EXPECT_FALSE(light.instead);
  }
}

}  // namespace
}  // namespace fb::scene
