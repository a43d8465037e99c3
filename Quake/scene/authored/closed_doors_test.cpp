// Light that was baked through doors: a slab lies across a room, with the lamp above it.
#include "scene/authored/closed_doors.h"

#include <gtest/gtest.h>

#include "scene/authored/authored_light.h"
#include "scene/library/test_lit_room.h"

namespace fb::scene {
namespace {

struct SlabInRoom {
  formats::Bsp bsp = test::lit_room().bsp;
  std::vector<EntityLight> lamps{test::lit_lamp(vec3(256, 256, 400), 20000)};
  Submodel slab{1, vec3(0.0f)};

  SlabInRoom() {  // between z = 150 and 160
    bsp.planes.push_back({vec3(0, 0, 1), 160.0f, 2});
    bsp.planes.push_back({vec3(0, 0, -1), -150.0f, 2});
    const auto planes = static_cast<std::uint32_t>(bsp.planes.size());
    const auto first = static_cast<std::int32_t>(bsp.nodes.size());
    formats::BspNode above{}, below{};
    above.plane = planes - 2, above.children = {~1, first + 1};
    below.plane = planes - 1, below.children = {~1, ~0};
    bsp.nodes.insert(bsp.nodes.end(), {above, below});
    formats::BspModel model = bsp.models[0];
    model.face_count = 0;
    model.head_nodes[0] = first;
    bsp.models.push_back(model);
  }
  std::vector<std::uint32_t> through() {
    bsp.lighting.clear();
    test::bake(bsp, [&](const vec3& p, const vec3& n) {
      float light = 0.0f;
      for (const EntityLight& lamp : lamps)
        if (lamp.axis.z == 0.0f || p.z < lamp.position.z) light += test::lamp_light(lamp, p, n);
      return light;
    });
    LitMap map = test::lit_map(bsp);
    map.lamps = lamps;
    map.submodels = {slab};
    const auto found = find_authored_light(map, Lightmaps(bsp));
    EXPECT_TRUE(found);
    return found ? found->lit_through : std::vector<std::uint32_t>{99};
  }
};

TEST(ClosedDoors, LetThroughWhatAPlaceWasBakedWith) {
  SlabInRoom room;
  EXPECT_EQ(room.through(), std::vector<std::uint32_t>{1});
}

TEST(ClosedDoors, CastShadowsWhereTheirPlaceHasLightOfItsOwn) {
  SlabInRoom room;
  EntityLight below = test::lit_lamp(vec3(256, 256, 148), 60000);  // its light goes down
  below.axis = vec3(0, 0, -1);
  below.least_cosine = below.full_cosine = 0.0f;
  room.lamps.push_back(below);
  EXPECT_TRUE(room.through().empty());
}

TEST(ClosedDoors, StandWhereTheirEntityRests) {
  SlabInRoom room;
  room.slab.offset = vec3(0, 0, -1000);
  EXPECT_TRUE(room.through().empty());
}

}  // namespace
}  // namespace fb::scene
