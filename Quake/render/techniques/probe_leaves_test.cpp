// Where probes stand in a map's space, who may ask them, and what counts as a door: on trees and boxes in code.
#include "render/techniques/probe_leaves.h"

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <vector>

#include "base/rng.h"
#include "estimators/ddgi/ddgi.h"
#include "render/techniques/probe_doors.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_of_rooms.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

LeafGraph graph_of(const scene::FrameSnapshot& scene) { return LeafGraph(scene.assets->map); }

bool asks(const LeafGraph& graph, const vec3& point, const vec3& probe, float reach,
          const std::vector<Bounds>& doors = {}) {
  std::vector<std::uint32_t> row(graph.row_words());
  graph.reached_from(probe, {probe - reach, probe + reach}, doors, row);
  const std::uint32_t leaf = graph.at(point);
  EXPECT_NE(leaf, 0u);
  return (row[leaf / 32] >> (leaf % 32) & 1u) != 0;
}

TEST(ProbeLeaves, NoWayLeadsThroughAThinWall) {
  const LeafGraph graph = graph_of(scene::thin_wall());
  EXPECT_EQ(graph.at({0.5f, 0, 80}), 0u) << "in the wall";
  EXPECT_TRUE(asks(graph, {-1, 0, 80}, {-40, 0, 80}, 80));
  EXPECT_FALSE(asks(graph, {-1, 0, 80}, {40, 0, 80}, 80));
  EXPECT_TRUE(asks(graph, {2, 0, 80}, {40, 0, 80}, 80));
}

// Through a doorway that is near a way leads, past one that is further away than the probe's surroundings none.
TEST(ProbeLeaves, AWayLeadsThroughADoorwayThatIsNear) {
  const LeafGraph graph = graph_of(scene::split_room());
  EXPECT_TRUE(asks(graph, {-40, 0, 40}, {40, 0, 40}, 80));
  EXPECT_FALSE(asks(graph, {-40, 100, 140}, {40, 100, 140}, 40));
}

// A door in the doorway closes it, but not the doorway itself on either side; a box that leaves room beside it does
// not.
TEST(ProbeLeaves, DoorsCloseOpenings) {
  const LeafGraph graph = graph_of(scene::split_room());
  const vec3 here(-40, 0, 40), there(40, 0, 40);
  const std::vector<Bounds> door{{{-4, -24, 0}, {4, 24, 96}}}, crate{{{-4, -24, 0}, {4, 10, 96}}};
  EXPECT_FALSE(asks(graph, here, there, 80, door));
  EXPECT_TRUE(asks(graph, {6, 0, 40}, there, 80, door));
  EXPECT_TRUE(asks(graph, here, there, 80, crate));
}

// A leaf that the map's visibility does not show is not asked, though the way is open.
TEST(ProbeLeaves, VisibilityCounts) {
  auto bsp = std::make_shared<formats::Bsp>(*scene::split_room().assets->map);
  const LeafGraph open(bsp);
  const vec3 here(-40, 0, 40), there(40, 0, 40);
  EXPECT_TRUE(asks(open, here, there, 80));
  for (formats::BspLeaf& leaf : bsp->leafs) leaf.vis_offset = 0;
  const std::size_t row = (bsp->models[0].visible_leafs + std::size_t{7}) / 8;
  bsp->visibility = {0, static_cast<std::uint8_t>(row)};  // all zeros: nothing is seen
  const LeafGraph blind(bsp);
  EXPECT_FALSE(asks(blind, here, there, 80));
  EXPECT_TRUE(asks(blind, there, there, 80)) << "its own leaf";
}

TEST(ProbeLeaves, ProbesStandInTheOpen) {
  const LeafGraph graph = graph_of(scene::split_room());
  const vec3 room(30);
  // In the wall, at most a third of the way from its middle to either room.
  const std::optional<vec3> beside = graph.open_place({2, 80, 40}, room);
  ASSERT_TRUE(beside);
  EXPECT_NE(graph.at(*beside), 0u);
  EXPECT_LE(glm::length(*beside - vec3(2, 80, 40)), 10.1f);
  EXPECT_EQ(graph.open_place({60, 80, 40}, room), std::optional(vec3(60, 80, 40))) << "in a room it stays";
  EXPECT_FALSE(graph.open_place({600, 80, 40}, room)) << "in the void there is none";
}

// A walk from where a box's begins, as shaders take it, ends where one from the root does, within the steps it says.
TEST(ProbeLeaves, WalksBeginWhereABoxDoes) {
  const LeafGraph graph = graph_of(scene::split_room());
  const std::vector<shared::uvec4> nodes = graph.nodes();
  Rng rng(5);
  for (int i = 0; i < 200; ++i) {
    const vec3 low(rng.uniform(-260, 260), rng.uniform(-140, 140), rng.uniform(-20, 180));
    const Bounds box{low, low + 60.0f};
    const LeafGraph::Start start = graph.start_in(box);
    for (int k = 0; k < 8; ++k) {
      const vec3 point = low + 60.0f * vec3(rng.uniform(), rng.uniform(), rng.uniform());
      std::int32_t at = start.at;
      std::uint32_t steps = 0;
      for (; at >= 0; ++steps) {
        const shared::uvec4 plane = nodes[2 * static_cast<std::size_t>(at)];
        const vec3 normal(std::bit_cast<float>(plane.x), std::bit_cast<float>(plane.y), std::bit_cast<float>(plane.z));
        const shared::uvec4 sides = nodes[2 * static_cast<std::size_t>(at) + 1];
        at = static_cast<std::int32_t>(glm::dot(normal, point) >= std::bit_cast<float>(plane.w) ? sides.x : sides.y);
      }
      EXPECT_LE(steps, start.steps);
      EXPECT_EQ(static_cast<std::uint32_t>(~at), graph.at(point));
    }
  }
}

TEST(ProbeDoors, OnlyWhatFillsItsBoxShuts) {
  auto assets = scene::new_code_assets();
  const std::uint32_t wood = scene::add_material(*assets, "wood", vec3(0.5f));
  const auto shuts_of = [&](const auto& add) {
    scene::Mesh mesh;
    add(mesh);
    return shuts(*assets, assets->meshes[scene::add_finished(*assets, std::move(mesh), "door")], 0);
  };
  const auto door = [&](scene::Mesh& mesh) { scene::add_box(mesh, {-4, -24, 0}, {4, 24, 96}, wood); };
  EXPECT_TRUE(shuts_of(door));
  EXPECT_FALSE(shuts_of([&](scene::Mesh& mesh) {  // posts and a lintel
    scene::add_box(mesh, {-4, -24, 0}, {4, -16, 96}, wood);
    scene::add_box(mesh, {-4, 16, 0}, {4, 24, 96}, wood);
    scene::add_box(mesh, {-4, -16, 80}, {4, 16, 96}, wood);
  }));
  assets->materials[wood].alpha = 0.5f;
  EXPECT_FALSE(shuts_of(door)) << "translucent";
  assets->materials[wood].alpha = 1.0f;
  assets->materials[wood].flags = scene::kMaterialAlphaTest;
  EXPECT_FALSE(shuts_of(door)) << "a grating";
}

TEST(ProbeDoors, AreBoxesOfEntities) {
  scene::FrameSnapshot scene = scene::split_room(true);
  const Bounds everywhere{vec3(-1000), vec3(1000)};
  ProbeDoors doors;
  ASSERT_EQ(doors.find(scene, everywhere, 9).size(), 1u) << "lamps and the world are none";
  scene.instances.back().transform[3].z = 90;
  EXPECT_EQ(doors.find(scene, everywhere, 9)[0].min.z, 90.0f) << "where it stands now";
  EXPECT_TRUE(doors.find(scene, {vec3(500), vec3(1000)}, 9).empty()) << "far away";
  EXPECT_TRUE(doors.find(scene, everywhere, 0).empty());
  scene.instances.back().transform[0].y = 0.3f;
  EXPECT_TRUE(doors.find(scene, everywhere, 9).empty()) << "one that has turned is no box";
}

}  // namespace
}  // namespace fb::render
