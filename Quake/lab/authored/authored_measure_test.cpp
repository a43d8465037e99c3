#include "lab/authored/authored_measure.h"
#include "lab/authored/authored_report.h"

#include <gtest/gtest.h>

#include <cmath>

#include <functional>

namespace fb::lab {
namespace {

Picture blocks(const std::function<vec3(std::uint32_t, std::uint32_t)>& color) {
  Picture p{160, 90, {}};
  for (std::uint32_t y = 0; y < p.height; ++y)
    for (std::uint32_t x = 0; x < p.width; ++x) p.pixels.push_back(color(x / 10, y / 10));
  return p;
}

TEST(AuthoredMeasure, EqualPicturesAreAtNoDistance) {
  const Picture p = blocks([](auto x, auto y) { return vec3(0.01f * static_cast<float>(1 + x + y)); });
  const AuthoredDistance d = authored_distance(p, p);
  EXPECT_EQ(d.median, 0.0);
  EXPECT_EQ(d.spread, 0.0);
  EXPECT_NEAR(d.correlation, 1.0, 1e-9);
  EXPECT_EQ(d.color, 0.0);
}

TEST(AuthoredMeasure, AFactorIsMedianAloneAndAColourColourAlone) {
  const Picture authors = blocks([](auto x, auto y) { return vec3(0.02f * static_cast<float>(1 + (x + y) % 8)); });
  Picture own = authors;
  for (vec3& c : own.pixels) c *= 4.0f;
  const AuthoredDistance bright = authored_distance(own, authors);
  EXPECT_NEAR(bright.median, 2.0, 0.05);
  EXPECT_LT(bright.spread, 0.05);
  EXPECT_GT(bright.correlation, 0.99);
  // A grey of this luminance, and a red of the same.
  for (std::size_t i = 0; i < own.pixels.size(); ++i) own.pixels[i] = vec3(authors.pixels[i].x / 0.2126f, 0, 0);
  const AuthoredDistance red = authored_distance(own, authors);
  EXPECT_NEAR(red.color, 4.0 / 3.0, 1e-5);
  EXPECT_NEAR(red.median, 0.0, 0.2) << "but for what is whiter than white";
}

TEST(AuthoredMeasure, SpreadIsTheRmsOfWhatTheMedianLeaves) {
  const Picture authors = blocks([](auto, auto) { return vec3(0.1f); });
  const Picture own = blocks([](auto x, auto) { return vec3(x < 8 ? 0.05f : 0.2f); });  // a stop down, a stop up
  EXPECT_NEAR(authored_distance(own, authors).spread, 1.0, 0.02);
  const AuthoredDistance mean = mean_distance({{1, 3, 0.5, 0.1}, {-1, 4, 0.7, 0.3}});
  EXPECT_NEAR(mean.median, 1.0, 1e-9);
  EXPECT_NEAR(mean.spread, std::sqrt(12.5), 1e-9);
  EXPECT_NEAR(mean.correlation, 0.6, 1e-9);
}

TEST(AuthoredMeasure, WhatIsBlackInBothPicturesIsNotCompared) {
  const Picture black = blocks([](auto, auto) { return vec3(0.0f); });
  const Picture lit = blocks([](auto x, auto) { return vec3(x == 3 ? 0.01f : 0.0f); });
  const AuthoredDistance none = authored_distance(black, black);
  EXPECT_TRUE(none.black);
  EXPECT_FALSE(authored_distance(black, lit).black);
  EXPECT_FALSE(authored_distance(lit, black).black);
  const AuthoredDistance mean = mean_distance({{1, 3, 0.5, 0.1}, none, {-1, 3, 0.7, 0.3}});
  EXPECT_FALSE(mean.black);
  EXPECT_NEAR(mean.spread, 3.0, 1e-9);
  EXPECT_NEAR(mean.correlation, 0.6, 1e-9);
  EXPECT_TRUE(mean_distance({none, none}).black);
}

TEST(AuthoredMeasure, CamerasStandWhereTheMapSays) {
  formats::Bsp bsp;
  formats::BspLeaf solid{}, empty{};
  solid.contents = formats::kContentsSolid;
  empty.contents = formats::kContentsEmpty;
  formats::BspLeaf lava{};
  lava.contents = formats::kContentsLava;
  bsp.leafs = {solid, empty, lava};
  formats::BspNode door{};  // of lava beyond x = 100
  bsp.planes = {{vec3(1, 0, 0), 100.0f, 0}};
  door.children = {~2, ~1};
  bsp.nodes = {door};
  formats::BspModel model{}, submodel{};
  model.head_nodes = {~1, -1, -1, -1};
  submodel.head_nodes = {0, -1, -1, -1};
  bsp.models = {model, submodel};
  bsp.entities =
      "{\"classname\" \"info_player_start\" \"origin\" \"1 2 3\" \"angle\" \"90\"}"
      "{\"classname\" \"info_intermission\" \"origin\" \"4 5 6\" \"mangle\" \"10 20 0\"}"
      "{\"classname\" \"light\" \"origin\" \"7 8 9\"}{\"classname\" \"info_player_deathmatch\"}"
      "{\"classname\" \"info_player_coop\" \"origin\" \"nan 0 0\"}"
      "{\"classname\" \"func_door\" \"model\" \"*1\"}"
      "{\"classname\" \"info_teleport_destination\" \"origin\" \"150 0 0\"}";
  const auto [cameras, closed, nowhere] = map_cameras(bsp, 10);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(closed, std::vector<std::string>{"info_teleport_destination_1"});
  EXPECT_EQ(nowhere, (std::vector<std::string>{"info_player_deathmatch_1", "info_player_coop_1"}));
  EXPECT_TRUE(in_open(bsp, vec3(99, 0, 0)));
  EXPECT_FALSE(in_open(bsp, vec3(101, 0, 0))) << "within the door";
  EXPECT_EQ(cameras[0].position, vec3(1, 2, 25));
  EXPECT_EQ(cameras[0].angles, vec3(0, 90, 0));
  EXPECT_EQ(cameras[1].position, vec3(4, 5, 6));
  EXPECT_EQ(cameras[1].angles, vec3(10, 20, 0));
  EXPECT_EQ(map_cameras(bsp, 1).open.size(), 1u);
  bsp.models[0].head_nodes[0] = ~0;  // solid all over
  EXPECT_FALSE(in_open(bsp, vec3(0, 0, 0)));
  EXPECT_EQ(map_cameras(bsp, 10).closed.size(), 3u);
}

TEST(AuthoredReport, ThePageHasPicturesAndEmittersAndNoMarkupOfTheirs) {
  AuthoredPage page{"start <b>",
                    {"one & all"},
                    {{"info_1", "info_1.png", {-0.5, 0.25, 0.875, 0.0625}}},
                    {-0.5, 0.25, 0.875, 0.0625},
                    {}};
  page.rows.push_back({"info_2", "", {0, 0, 0, 0, true}});
  EXPECT_EQ(authored_html(page).find("Emitters"), std::string::npos);
  page.emitters.push_back({"texture \"a\" & b", vec3(0.5f, 1.0f, 2.0f), 0.125f});
  const std::string html = authored_html(page);
  for (const char* part :
       {"start &lt;b&gt;", "<p>one &amp; all</p>", "<td>info_2</td><td colspan=\"4\">black", "<img src=\"info_1.png\"",
        "<td>-0.50</td><td>0.25</td><td>0.88</td><td>0.06</td>", "texture &quot;a&quot; &amp; b",
        "<td>0.5000</td><td>1.0000</td><td>2.0000</td><td>12.50</td>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace fb::lab
