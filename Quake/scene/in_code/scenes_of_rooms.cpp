#include "scene/in_code/scenes_of_rooms.h"

#include <array>
#include <utility>

#include "scene/shapes.h"

namespace fb::scene {
namespace {

// Half a room's width and a room's height, units.
constexpr float kRoomHalf = 120.0f, kRoomHigh = 160.0f;

// Planes of the grid along each axis divide it into intervals, of which the first and the last lie outside of it.
class TreeMaker {
 public:
  explicit TreeMaker(const BlockGrid& grid) : grid_(grid), planes_{grid.x, grid.y, grid.z} {
    formats::BspLeaf leaf{};
    leaf.contents = formats::kContentsSolid;
    leaf.vis_offset = -1;
    bsp_.leafs.push_back(leaf);
  }

  formats::Bsp make() {
    Box all;
    for (std::size_t axis = 0; axis < 3; ++axis) all[axis] = {0, planes_[axis].size() + 1};
    formats::BspModel model{};
    model.head_nodes = {node_of(all), -1, -1, -1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      model.mins[static_cast<int>(axis)] = planes_[axis].front();
      model.maxs[static_cast<int>(axis)] = planes_[axis].back();
    }
    model.visible_leafs = static_cast<std::uint32_t>(bsp_.leafs.size() - 1);
    bsp_.models.push_back(model);
    return std::move(bsp_);
  }

 private:
  struct Range {
    std::size_t begin = 0, end = 0;  // intervals
  };
  using Box = std::array<Range, 3>;

  bool is_air(std::size_t x, std::size_t y, std::size_t z) const {
    const std::array<std::size_t, 3> at{x, y, z};
    vec3 centre(0.0f);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] == 0 || at[axis] == planes_[axis].size()) return false;
      centre[static_cast<int>(axis)] = 0.5f * (planes_[axis][at[axis] - 1] + planes_[axis][at[axis]]);
    }
    return grid_.air(centre);
  }
  // Node, or ~leaf.
  std::int32_t node_of(const Box& box) {
    bool air = false, rock = false;
    for (std::size_t x = box[0].begin; x < box[0].end; ++x)
      for (std::size_t y = box[1].begin; y < box[1].end; ++y)
        for (std::size_t z = box[2].begin; z < box[2].end; ++z) (is_air(x, y, z) ? air : rock) = true;
    if (!air) return ~0;
    if (!rock) {
      formats::BspLeaf leaf{};
      leaf.contents = formats::kContentsEmpty;
      leaf.vis_offset = -1;
      bsp_.leafs.push_back(leaf);
      return ~static_cast<std::int32_t>(bsp_.leafs.size() - 1);
    }
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (box[a].end - box[a].begin > box[axis].end - box[axis].begin) axis = a;
    const std::size_t middle = (box[axis].begin + box[axis].end) / 2;
    const auto at = bsp_.nodes.size();
    bsp_.nodes.emplace_back();
    vec3 normal(0.0f);
    normal[static_cast<int>(axis)] = 1.0f;
    const auto plane = static_cast<std::uint32_t>(bsp_.planes.size());
    bsp_.planes.push_back({normal, planes_[axis][middle - 1], static_cast<std::int32_t>(axis)});
    Box front = box, back = box;
    front[axis].begin = back[axis].end = middle;
    const std::int32_t before = node_of(front), behind = node_of(back);
    bsp_.nodes[at].plane = plane;
    bsp_.nodes[at].children = {before, behind};
    return static_cast<std::int32_t>(at);
  }

  const BlockGrid& grid_;
  std::array<std::vector<float>, 3> planes_;
  formats::Bsp bsp_;
};

FrameSnapshot rooms_of(BlockGrid grid, const Camera& camera, bool lit) {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.7f));
  const std::uint32_t light = add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  grid.material = [walls](const vec3&, const vec3&) { return walls; };
  Mesh rooms;
  add_carved(rooms, grid);
  const std::uint32_t mesh = add_finished(*assets, std::move(rooms), "rooms");
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  assets->map = block_tree(grid);
  FrameSnapshot snapshot = still(assets, camera);
  snapshot.instances.push_back(make_instance(kIdWorld, mesh));
  snapshot.instances.push_back(glowing(kRoomLamp, sphere, light, {120, 40, 100}, vec3(10.0f), vec3(100.0f)));
  if (lit)
    snapshot.instances.push_back(glowing(kRoomLamp + 1, sphere, light, {-150, -60, 110}, vec3(10.0f), vec3(0.5f)));
  return snapshot;
}

}  // namespace

std::shared_ptr<const formats::Bsp> block_tree(const BlockGrid& grid) {
  return std::make_shared<const formats::Bsp>(TreeMaker(grid).make());
}

FrameSnapshot thin_wall(bool lit) {
  BlockGrid grid;
  grid.x = {-2 * kRoomHalf, 0, 1, 2 * kRoomHalf};
  grid.y = {-kRoomHalf, kRoomHalf};
  grid.z = {0, kRoomHigh};
  grid.air = [](const vec3& p) { return p.x < 0.0f || p.x > 1.0f; };
  return rooms_of(std::move(grid), camera_at({-220, 0, 80}, {10, 0, 0}, 90.0f), lit);
}

FrameSnapshot split_room(bool shut) {
  constexpr float kWall = 8.0f, kDoorHalf = 24.0f, kDoorHigh = 96.0f;
  BlockGrid grid;
  grid.x = {-2 * kRoomHalf, -kWall, kWall, 2 * kRoomHalf};
  grid.y = {-kRoomHalf, -kDoorHalf, kDoorHalf, kRoomHalf};
  grid.z = {0, kDoorHigh, kRoomHigh};
  grid.air = [](const vec3& p) { return std::abs(p.x) > kWall || (std::abs(p.y) < kDoorHalf && p.z < kDoorHigh); };
  FrameSnapshot snapshot = rooms_of(std::move(grid), camera_at({-220, -60, 80}, {10, 15, 0}, 90.0f), false);
  if (!shut) return snapshot;
  auto assets = std::make_shared<Assets>(*snapshot.assets);
  Mesh door;
  add_box(door, {-4, -kDoorHalf, 0}, {4, kDoorHalf, kDoorHigh}, 0);
  const std::uint32_t mesh = add_finished(*assets, std::move(door), "door");
  assets->generation = next_generation();
  snapshot.assets = std::move(assets);
  snapshot.instances.push_back(make_instance(kRoomDoor, mesh));
  return snapshot;
}

FrameSnapshot red_ball() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.75f));
  const std::uint32_t red = add_material(*assets, "red", vec3(0.63f, 0.06f, 0.05f));
  const std::uint32_t light = add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  BlockGrid grid;
  grid.x = grid.y = {-160, 160};
  grid.z = {0, 256};
  grid.air = [](const vec3&) { return true; };
  grid.material = [walls](const vec3&, const vec3&) { return walls; };
  Mesh room;
  add_carved(room, grid);
  const std::uint32_t mesh = add_finished(*assets, std::move(room), "box");
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  assets->map = block_tree(grid);
  FrameSnapshot snapshot = still(assets, camera_at({-150, 0, 120}, {12, 0, 0}, 80.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, mesh));
  Instance ball = make_instance(kIdEntity + 1, sphere, placed({40, 0, 62}, vec3(60)));
  ball.material_base = red;
  snapshot.instances.push_back(ball);
  snapshot.instances.push_back(glowing(kRoomLamp, sphere, light, {-20, 60, 225}, vec3(12.0f), vec3(60.0f)));
  return snapshot;
}

}  // namespace fb::scene
