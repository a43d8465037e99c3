#include "lab/track.h"

#include <gtest/gtest.h>

#include "formats/dem.h"
#include "net/server_messages.h"

namespace fb::lab {
namespace {

// A demo in which entity 1, the player, goes `steps` units along x a message, and entity 2 the other way.
Bytes walking_demo(float steps, int messages) {
  Bytes demo{'-', '1', '\n'};
  net::Protocol protocol;
  net::MessageWriter first(protocol);
  net::svc::SpawnBaseline baseline;
  baseline.entity = 1;
  baseline.state.origin = {100, 200, 300};
  net::svc::ServerInfo info;
  info.protocol = protocol;
  info.models = {"maps/x.bsp"};
  net::write_server_message(first, info);
  net::write_server_message(first, baseline);
  net::write_server_message(first, net::svc::SetView{1});
  formats::append_dem_message(demo, {0, 0, 0}, first.bytes());
  for (int i = 0; i < messages; ++i) {
    net::MessageWriter next(protocol);
    net::write_server_message(next, net::svc::Time{1.0f + 0.05f * static_cast<float>(i)});
    net::svc::ClientData data;
    data.velocity = {20, 0, -1};
    data.on_ground = true;
    data.health = 100;
    net::write_server_message(next, data);
    for (const int entity : {1, 2}) {
      net::svc::EntityUpdate update;
      update.entity = entity;
      update.bits = net::kUpdateOrigin1;
      update.origin.x = 100.0f + (entity == 1 ? steps : -steps) * static_cast<float>(i);
      net::write_server_message(next, update);
    }
    formats::append_dem_message(demo, {5, 90, 0}, next.bytes());
  }
  return demo;
}

TEST(Track, FollowsThePlayerOverItsBaseline) {
  const auto track = read_track(walking_demo(2.0f, 10), "walk.dem");
  ASSERT_TRUE(track.ok()) << track.error().message;
  ASSERT_EQ(track->size(), 10u);
  EXPECT_EQ((*track)[9].origin, vec3(118, 200, 300));
  EXPECT_EQ((*track)[9].velocity, vec3(320, 0, -16));
  EXPECT_EQ((*track)[9].view_angles, vec3(5, 90, 0));
  EXPECT_TRUE((*track)[9].on_ground);
  EXPECT_EQ((*track)[9].health, 100);
}

TEST(Track, SaysWhereTwoPart) {
  const auto a = read_track(walking_demo(2.0f, 10), "a.dem"), b = read_track(walking_demo(2.125f, 8), "b.dem");
  ASSERT_TRUE(a.ok() && b.ok());
  const TrackDifference d = compare_tracks(*a, *b, 0.25f);
  EXPECT_EQ(d.points, 8u);
  EXPECT_EQ(d.largest, 0.875f);
  EXPECT_EQ(d.at, 7u);
  EXPECT_EQ(d.first, 3u);  // 3 * 0.125 is more than a quarter
  EXPECT_FALSE(d.within);
  EXPECT_TRUE(compare_tracks(*a, *a, 0.0f).within);
}

TEST(Track, FindsHowFarOneIsBehind) {
  const auto a = read_track(walking_demo(2.0f, 10), "a.dem");
  ASSERT_TRUE(a.ok());
  const std::vector<TrackPoint> late(a->begin() + 3, a->end());
  EXPECT_EQ(compare_tracks(*a, late, 0.125f, 2).largest, 2.0f);
  const TrackDifference d = compare_tracks(*a, late, 0.125f, 4), e = compare_tracks(late, *a, 0.125f, 4);
  EXPECT_EQ(d.shift, -3);
  EXPECT_EQ(d.points, 7u);
  EXPECT_TRUE(d.within);
  EXPECT_EQ(e.shift, 3);
  EXPECT_EQ(e.largest, 0.0f);
}

TEST(Track, WritesALineAPoint) {
  const auto track = read_track(walking_demo(2.0f, 2), "walk.dem");
  ASSERT_TRUE(track.ok());
  EXPECT_EQ(track_csv(*track),
            "time,x,y,z,vx,vy,vz,ground,water,health\n1,100,200,300,320,0,-16,1,0,100\n"
            "1.0499999523162842,102,200,300,320,0,-16,1,0,100\n");
}

TEST(Track, SaysWhatIsWrongWithADemo) {
  Bytes demo = walking_demo(2.0f, 2);
  demo.resize(demo.size() - 3);
  EXPECT_FALSE(read_track(demo, "cut.dem").ok());
}

}  // namespace
}  // namespace fb::lab
