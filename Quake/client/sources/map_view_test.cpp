// Maps without a server, as the client shows them.
#include "client/sources/map_view.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "client/test_game.h"

namespace fb::cl {
namespace {

using test::Game;
using test::walk;
using testing::HasSubstr;
using testing::Not;

TEST_F(Game, MapsCanBeSeenWithoutAServer) {
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  room.models[1] = room.models[0];
  room.entities =
      "{\"classname\" \"worldspawn\" \"sky\" \"dusk_\"}"
      "{\"classname\" \"info_player_start\" \"origin\" \"8 -8 0\" \"angle\" \"90\"}"
      "{\"classname\" \"func_door\" \"model\" \"*1\"}"
      "{\"classname\" \"trigger_once\" \"model\" \"*1\"}"
      "{\"classname\" \"func_episodegate\" \"model\" \"*1\" \"spawnflags\" \"1\"}"
      "{\"classname\" \"func_wall\" \"model\" \"*1\" \"spawnflags\" \"1792\"}"  // in deathmatch alone
      "{\"classname\" \"light\" \"origin\" \"0 0 32\" \"light\" \"200\" \"style\" \"33\" \"spawnflags\" \"1\"}"
      "{\"classname\" \"light\" \"origin\" \"0 0 64\" \"light\" \"200\"}";
  files.files["maps/view.bsp"] = formats::testing::write_bsp(room);
  EXPECT_FALSE(client.map_view("nowhere").ok());
  const Status status = client.map_view("view");
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_TRUE(client.active());
  client.set_view_size(1920, 1080);
  client.advance(0.0);
  client.build_snapshot(snapshot);
  EXPECT_EQ(snapshot.camera.position, vec3(8, -8, 23));
  EXPECT_EQ(snapshot.camera.angles, vec3(0, 90, 0));
  EXPECT_NEAR(snapshot.camera.fov_x, 106.26f, 0.01f);
  int doors = 0, lamps = 0;
  for (const auto& i : snapshot.instances) {
    doors += i.id >= scene::kIdStatic && i.id < scene::kIdViewModel;
    lamps += i.id >= scene::kIdEntityLight;
  }
  EXPECT_EQ(doors, 1) << "a game alone shows no more when it begins";
  EXPECT_EQ(lamps, 1) << "one is switched off";
  EXPECT_TRUE(snapshot.cut);
  client.advance(0.1);
  client.build_snapshot(snapshot);
  EXPECT_FALSE(snapshot.cut);
  for (const auto& i : snapshot.instances) EXPECT_EQ(i.transform, i.prev_transform);
  client.set_camera(scene::Camera{{0, 0, 64}, {10, 20, 0}, 70.0f, 0.0f});
  client.build_snapshot(snapshot);
  EXPECT_EQ(snapshot.camera.angles, vec3(10, 20, 0));
  EXPECT_EQ(snapshot.camera.fov_x, 70.0f);

  client.set_camera(std::nullopt);
  client.set_view_size(640, 480);
  ASSERT_TRUE(console.set("fov", "60"));
  ASSERT_TRUE(client.map_view("view").ok());
  client.build_snapshot(snapshot);
  EXPECT_NEAR(snapshot.camera.fov_x, 60.0f, 0.01f) << "what was set counts from the first frame on";
}

TEST_F(Game, TheCameraIsAndWasInALiquid) {
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  for (auto& leaf : room.leafs)
    if (leaf.contents == formats::kContentsEmpty) leaf.contents = formats::kContentsLava;
  room.entities = "{\"classname\" \"worldspawn\"}{\"classname\" \"info_player_start\" \"origin\" \"8 -8 0\"}";
  files.files["maps/bath.bsp"] = formats::testing::write_bsp(room);
  ASSERT_TRUE(client.map_view("bath").ok());
  const auto expect = [&](bool is, bool was) {
    client.build_snapshot(snapshot);
    EXPECT_EQ(snapshot.in_liquid, is);
    EXPECT_EQ(snapshot.was_in_liquid, was);
    EXPECT_EQ(snapshot.camera_liquid, scene::kNone) << "opaque lava";
    client.advance(0.1);
  };
  expect(true, true);  // a cut: as if it had been there
  client.set_camera(scene::Camera{{0, 0, 5000}, {0, 0, 0}, 70.0f, 0.0f});
  expect(false, true);
  expect(false, false);
  client.set_camera(std::nullopt);
  expect(true, false);
  expect(true, true);
}

// Keys of the world with and without _, in a map that is looked at and in a demo.
TEST_F(Game, TheMapSaysHowItsSkyLooks) {
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  const auto shown = [&](const std::string& keys, bool in_game) {
    room.entities = "{\"classname\" \"worldspawn\" \"fog\" \"0.5 1 0 0\" " + keys + "}";
    files.files["maps/test.bsp"] = formats::testing::write_bsp(room);
    if (in_game) {
      put("walk.dem", walk(5));
      console.append("playdemo walk\n");
      console.execute();
      client.advance(0.1);
    } else {
      EXPECT_TRUE(client.map_view("test").ok());
    }
    client.build_snapshot(snapshot);
    return snapshot.medium.sky;
  };
  for (const bool in_game : {false, true}) {
    ASSERT_TRUE(console.set("r_skyfog", "0.25"));
    EXPECT_EQ(shown("", in_game), 0.75f);
    EXPECT_EQ(shown("\"skyfog\" \"0\"", in_game), 1.0f);
    EXPECT_EQ(shown("\"_skyfog\" \"1\"", in_game), 0.0f);
    ASSERT_TRUE(console.set("r_skyfog", "0.5"));
    client.advance(0.1);
    client.build_snapshot(snapshot);
    EXPECT_EQ(snapshot.medium.sky, 0.5f) << "what is typed counts from then on";
    EXPECT_EQ(shown("\"skyfog\" \"0.125\"", in_game), 0.875f) << "and the next map's again";
    EXPECT_FALSE(shown("\"fog\" \"-1 0 0 1\"", in_game) < 0.0f);
    EXPECT_FALSE(snapshot.medium.scatters()) << "no fog is less than none";
  }
  for (const char* key : {"sky", "_sky", "skyname", "_skyname", "qlsky", "_qlsky"}) {
    log.clear();
    shown(fmt::format("\"{}\" \"dusk_\"", key), false);
    EXPECT_THAT(log, HasSubstr("gfx/env/dusk_")) << key;
  }
}

// A room of one dull texture, and these entities.
Bytes dull_room(const std::string& entities) {
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  for (auto& texture : room.textures) std::fill(texture.indices.begin(), texture.indices.end(), std::uint8_t{100});
  room.entities = entities;
  return formats::testing::write_bsp(room);
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_F(Game, AMapWithoutAnyLightIsShownInAnEvenOne) {
  files.files["maps/test.bsp"] = dull_room("{\"classname\" \"worldspawn\"}");
  const std::string sentence = "maps/test.bsp has no light";
  const auto shown = [&] {
    client.build_snapshot(snapshot);
    return snapshot.ambient;
  };
  ASSERT_TRUE(client.map_view("test").ok());
  EXPECT_EQ(shown(), vec3(1.0f));
  client.advance(0.1);
  EXPECT_EQ(shown(), vec3(1.0f));
  EXPECT_EQ(count_of(log, sentence), 1u) << log;

  put("walk.dem", walk(5));
  ASSERT_TRUE(client.start_demo("walk", DemoMode::kPlay).ok());
  frame();
  EXPECT_EQ(shown(), vec3(1.0f));
  EXPECT_EQ(count_of(log, sentence), 2u) << "once a map that is loaded";
  console.execute("r_ambient 0.25");
  frame();
  EXPECT_EQ(shown(), vec3(0.25f));
  client.stop();
  EXPECT_EQ(shown(), vec3(0.0f));

  log.clear();
  for (const float none : {0.0f, 0.5f}) {
    ASSERT_TRUE(console.set("r_ambient", std::to_string(none)));
    ASSERT_TRUE(client.map_view("test").ok());
    EXPECT_EQ(shown(), vec3(none));
  }
  EXPECT_EQ(count_of(log, sentence), 0u) << log;
}

TEST_F(Game, EvenLightIsWhatTheMapAsksFor) {
  files.files["maps/faint.bsp"] =
      dull_room("{\"classname\" \"worldspawn\" \"_minlight\" \"256\" \"_mincolor\" \"0 0 1\"}");
  files.files["maps/lamp.bsp"] = dull_room("{\"classname\" \"worldspawn\"}{\"classname\" \"light\"}");
  for (const auto& [map, radiance] : {std::pair("faint", vec3(0, 0, 1)), std::pair("lamp", vec3(0.0f))}) {
    ASSERT_TRUE(client.map_view(map).ok());
    client.build_snapshot(snapshot);
    EXPECT_EQ(snapshot.ambient, radiance) << map;
  }
  EXPECT_THAT(log, Not(HasSubstr("even light")));
}

}  // namespace
}  // namespace fb::cl
