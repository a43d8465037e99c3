// Measures traces a second on lq_e1m7: moves of a step's length and across the map, from points in the open, in each
// hull. FULLBRIGHT_TEST_DATA (../shared/librequake) names the data.
#include <benchmark/benchmark.h>

#include <optional>

#include "base/librequake.h"
#include "base/rng.h"
#include "fs/filesystem.h"
#include "world/pvs.h"
#include "world/trace.h"

namespace fb::world {
namespace {

const formats::Bsp* map_of_bench(benchmark::State& state) {
  static const std::optional<formats::Bsp> loaded = []() -> std::optional<formats::Bsp> {
    fs::FsOptions options;
    options.base_dir = librequake_folder();
    options.user_dir = "";
    const auto files = fs::FileSystem::open(options);
    if (!files) return std::nullopt;
    const auto bytes = files->load("maps/lq_e1m7.bsp");
    if (!bytes) return std::nullopt;
    auto bsp = formats::parse_bsp(*bytes, "maps/lq_e1m7.bsp");
    if (!bsp) return std::nullopt;
    return std::move(*bsp);
  }();
  if (!loaded) state.SkipWithError("no LibreQuake data");
  return loaded ? &*loaded : nullptr;
}

struct Line {
  vec3 start, end;
};
// length 0: to another point of the map.
std::vector<Line> lines_in_the_open(const formats::Bsp& bsp, const Hull& hull, float length) {
  Rng rng(1);
  const auto point = [&] {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = rng.uniform(bsp.models[0].mins[axis], bsp.models[0].maxs[axis]);
    return p;
  };
  std::vector<Line> lines;
  while (lines.size() < 4096) {
    const vec3 start = point();
    if (hull_point_contents(hull, start) == formats::kContentsSolid) continue;
    const vec3 there = point();
    lines.push_back({start, length == 0.0f ? there : start + length * glm::normalize(there - start)});
  }
  return lines;
}

void trace(benchmark::State& state) {
  const formats::Bsp* bsp = map_of_bench(state);
  if (bsp == nullptr) return;
  const MapHulls map(*bsp);
  const Hull hull = map.hull(0, static_cast<int>(state.range(0)));
  const auto lines = lines_in_the_open(*bsp, hull, static_cast<float>(state.range(1)));
  std::size_t i = 0;
  for (auto _ : state) {
    const Line& line = lines[i++ % lines.size()];
    benchmark::DoNotOptimize(trace_hull(hull, line.start, line.end));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(trace)->ArgNames({"hull", "units"})->ArgsProduct({{0, 1, 2}, {16, 0}});

void fat_pvs_at(benchmark::State& state) {
  const formats::Bsp* bsp = map_of_bench(state);
  if (bsp == nullptr) return;
  const auto lines = lines_in_the_open(*bsp, MapHulls(*bsp).hull(0, 0), 0.0f);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(fat_pvs(*bsp, lines[i++ % lines.size()].start));
}
BENCHMARK(fat_pvs_at);

}  // namespace
}  // namespace fb::world
