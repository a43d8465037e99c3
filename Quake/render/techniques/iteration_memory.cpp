#include "render/techniques/iteration_memory.h"

#include <algorithm>
#include <cmath>

#include "estimators/mir/mir.h"
#include "render/techniques/guiding_trees.h"
#include "render/techniques/path_store.h"
#include "render/techniques/technique.h"
#include "shared/seen_grid.h"

namespace fb::render {
namespace {

constexpr std::uint64_t kTexel = 16;   // of the device's arrays, and of a picture's sum
constexpr std::uint64_t kGrowth = 2;   // a vector that grows is there twice
constexpr std::uint64_t kSorted = 12;  // a vertex's place and weight in its leaf, as the host learns
constexpr std::uint64_t kBytesPerMegabyte = 1000000;

// Quarters with more than a share of a leaf's light split: on each level no more of them than its inverse.
std::uint64_t most_nodes(float share) {
  const double nodes = 1 + GuidingTrees::kMostNodeLevels / static_cast<double>(share);
  return static_cast<std::uint64_t>(std::min(nodes, static_cast<double>(shared::kMostGuidingNodes)));
}

}  // namespace

IterationMemory memory_of_iterations(const RenderSettings& settings, uvec2 size,
                                     std::span<const std::uint32_t> schedule) {
  IterationMemory memory;
  const std::uint64_t pixels = std::uint64_t{size.x} * size.y;
  const auto bounces = static_cast<std::uint64_t>(std::max(settings.bounces, 1));
  const bool halves = settings.mir_decorrelated != 0;
  const TechniqueInfo* technique = find_technique(settings.estimator);
  const bool looks = technique != nullptr && technique->wants_lights;
  const std::uint64_t lights = looks ? shared::kMirLightsLooked : shared::kMirLightsOfOne;
  const std::uint64_t frame = kTexel * pixels * ((3 + lights) * bounces + 2);
  memory.device = frame + kTexel * pixels * 3 / 2 + (looks ? shared::kSeenBytes : 0);  // with the final picture
  memory.pictures = pixels * (kTexel * schedule.size() + sizeof(glm::dvec3));

  const std::uint64_t node_bytes = most_nodes(settings.mir_share) * sizeof(shared::uvec4);
  std::uint64_t most_taught = 0, seen = 0, leaves = 1;
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    const std::uint32_t unseen = halves ? schedule[i] - schedule[i] / 2 : 0;
    const std::uint32_t teachers = halves ? unseen : schedule[i];
    const std::uint64_t taught = std::min(kMostTaught, pixels * bounces * teachers);
    seen += schedule[i] - unseen;
    most_taught = std::max(most_taught, taught);
    if (i + 1 == schedule.size()) break;  // nothing is learnt from the last
    const double split = static_cast<double>(settings.mir_split) * std::sqrt(static_cast<double>(teachers));
    leaves = std::max(leaves, 1 + static_cast<std::uint64_t>(2 * static_cast<double>(taught) / split));
    memory.snapshots += leaves * node_bytes;
  }
  if (settings.mir_outliers > 0) memory.pictures += pixels * seen * sizeof(vec3);
  memory.snapshots += leaves * node_bytes / sizeof(shared::uvec4) * sizeof(DirectionalTree::Node);
  memory.taught = frame + most_taught * (kGrowth * (sizeof(GuidingSample) + kSorted) + sizeof(std::uint32_t));

  if (!weighs_paths(static_cast<IterationWeights>(settings.mir_weights))) return memory;
  const std::uint64_t path = sizeof(PathStore::Path) + bounces * (sizeof(PathVertex) + (looks ? sizeof(LookedFor) : 0));
  const std::uint64_t room = static_cast<std::uint64_t>(settings.mir_storage) * kBytesPerMegabyte;
  memory.stored = kGrowth * std::min(pixels * seen * path, room + pixels * path);
  return memory;
}

}  // namespace fb::render
