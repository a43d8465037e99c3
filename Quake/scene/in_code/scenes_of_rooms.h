// Rooms made in code for estimators that keep light at places in the world, with the tree of a map that divides their
// space: what one room knows must not light another. All emission EmissionKind::kConstant.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/bsp.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/snapshot.h"

namespace fb::scene {

// The tree of a grid of blocks: its air, in open leafs of which each is a box, in what is solid. Visibility is not
// known.
std::shared_ptr<const formats::Bsp> block_tree(const BlockGrid& grid);

constexpr std::uint32_t kRoomLamp = kIdEntityLight;  // + 0 behind the wall, + 1 on the camera's side
constexpr std::uint32_t kRoomDoor = kIdEntity + 1;   // of split_room

// Hard: two rooms, 240 x 240 x 160 each, with a wall of one unit between them, far thinner than probes are apart. A
// bright lamp is in the other room; the one that the camera sees has a lamp of a two-hundredth of its radiance, or
// none: then all light is leaked (in kind, the failure of Majercik 2022's Living Room).
FrameSnapshot thin_wall(bool lit = true);

// Two such rooms with a doorway, 48 x 96, in a wall of sixteen units; the only lamp is in the one behind (in kind,
// Majercik 2022's Split Room). `shut`: a door of eight units fills the doorway, and all is dark.
FrameSnapshot split_room(bool shut = false);

// A red ball in a white box under one lamp (in kind, Majercik 2022's Red Ball).
FrameSnapshot red_ball();

}  // namespace fb::scene
