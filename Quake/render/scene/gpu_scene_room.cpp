#include "render/scene/gpu_scene_room.h"

#include <algorithm>
#include <numeric>

namespace fb::render {

void SceneRoom::add(const SceneRoom& other) {
  instances += other.instances;
  copies += other.copies;
  triangles += other.triangles;
  nodes += other.nodes;
  vertices += other.vertices;
}

void SceneRoom::take(const SceneRoom& other) {
  instances -= other.instances;
  copies -= other.copies;
  triangles -= other.triangles;
  nodes -= other.nodes;
  vertices -= other.vertices;
}

std::vector<bool> nearest_that_fit(std::span<const SceneDemand> demands, SceneRoom room) {
  SceneRoom all{.instances = 0};
  for (const SceneDemand& demand : demands) all.add(demand.room);
  std::vector<bool> fits(demands.size(), true);
  if (room.holds(all)) return fits;
  std::vector<std::size_t> order(demands.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return demands[a].distance < demands[b].distance; });
  for (const std::size_t i : order) {
    fits[i] = room.holds(demands[i].room);
    if (fits[i]) room.take(demands[i].room);
  }
  return fits;
}

}  // namespace fb::render
