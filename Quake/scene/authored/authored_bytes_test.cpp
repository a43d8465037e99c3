#include "scene/authored/authored_bytes.h"

#include <gtest/gtest.h>

#include "scene/library/test_lit_room.h"

namespace fb::scene {
namespace {

struct KeptRoom {
  formats::Bsp bsp = test::lit_room().bsp;
  std::vector<EntityLight> lamps{test::lit_lamp(vec3(120, 130, 300), 20000)};
  KeptRoom() {
    test::bake(bsp, [&](const vec3& p, const vec3& n) { return 0.4f * test::lamp_light(lamps[0], p, n); });
  }
  LitMap map() const {
    LitMap lit = test::lit_map(bsp);
    lit.lamps = lamps;
    return lit;
  }
  static const std::optional<AuthoredLight>& found() {
    static const KeptRoom room;
    static const std::optional<AuthoredLight> light = find_authored_light(room.map(), Lightmaps(room.bsp));
    return light;
  }
  std::uint64_t key() const { return authored_key(map(), Lightmaps(bsp)); }
};

TEST(AuthoredBytesSequences, WhatIsReadIsWhatWasFound) {
  const KeptRoom room;
  const auto& found = room.found();
  ASSERT_TRUE(found);
  AuthoredLight with_doors = *found;
  with_doors.lit_through = {2, 7};
  EXPECT_EQ(read_authored(authored_bytes(with_doors, room.key()), room.key(), room.map())->lit_through,
            with_doors.lit_through);
  const Bytes bytes = authored_bytes(*found, room.key());
  const auto read = read_authored(bytes, room.key(), room.map());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->fit.factors, found->fit.factors);
  EXPECT_EQ(read->fit.shares, found->fit.shares);
  EXPECT_EQ(read->fit.stops_after, found->fit.stops_after);
  EXPECT_EQ(read->points, found->points);
  EXPECT_EQ(read->gains.cells, found->gains.cells);
  EXPECT_EQ(read->gains.origin, found->gains.origin);
  EXPECT_EQ(read->gains.width, found->gains.width);
  EXPECT_FALSE(read->gains.empty());
  ASSERT_EQ(read->emitters.all.size(), found->emitters.all.size());
  EXPECT_EQ(authored_bytes(*read, room.key()), bytes);
}

TEST(AuthoredBytesSequences, DamagedOnesAreRefused) {
  const KeptRoom room;
  const auto& found = room.found();
  ASSERT_TRUE(found);
  const Bytes bytes = authored_bytes(*found, room.key());
  EXPECT_FALSE(read_authored(bytes, room.key() + 1, room.map())) << "of another map";
  for (std::size_t size = 0; size < bytes.size(); size = size < 300 ? size + 1 : size + 997)
    ASSERT_FALSE(read_authored(ByteView(bytes).first(size), room.key(), room.map())) << size;
  for (std::size_t at = 0; at < bytes.size(); at = at < 300 ? at + 1 : at + 997) {
    Bytes bad = bytes;
    bad[at] ^= 0x10u;
    ASSERT_FALSE(read_authored(bad, room.key(), room.map())) << at;
  }
}

TEST(AuthoredBytesSequences, TheKeyIsOfAllThatLightIsFoundFrom) {
  const KeptRoom room;
  const std::uint64_t key = room.key();
  EXPECT_EQ(KeptRoom().key(), key);
  KeptRoom other = room;
  other.lamps[0].power_color.x *= 1.5f;
  EXPECT_NE(other.key(), key);
  other = room;
  other.bsp.lighting[100] ^= 1u;
  EXPECT_NE(other.key(), key);
  other = room;
  other.bsp.vertices[0].x += 1.0f;
  EXPECT_NE(other.key(), key);
  LitMap darker = room.map();
  darker.surfaces[0].reflectance *= 0.5f;
  EXPECT_NE(authored_key(darker, Lightmaps(room.bsp)), key);
}

}  // namespace
}  // namespace fb::scene
