// Fuzz target: a map of a stranger's making, then moves through it, contents and visibility. The input's first twelve
// bytes choose the lines. Nothing may crash, hang or come out of order.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/check.h"
#include "base/rng.h"
#include "world/pvs.h"
#include "world/trace.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fb;
  if (size < 12) return 0;
  std::uint32_t seed = 0;
  float reach = 0.0f;
  vec3 size_of_box(0.0f);
  std::memcpy(&seed, data, 4);
  std::memcpy(&reach, data + 4, 4);
  std::memcpy(&size_of_box.x, data + 8, 4);
  const auto bsp = formats::parse_bsp({data + 12, size - 12}, "fuzz.bsp");
  if (!bsp) return 0;
  const world::MapHulls map(*bsp);
  Rng rng(seed);
  const auto point = [&] {
    const float x = rng.uniform(-reach, reach), y = rng.uniform(-reach, reach);
    return vec3(x, y, rng.uniform(-reach, reach));
  };
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t model = rng.below(map.model_count());
    const world::Move move{point(), vec3(0.0f), size_of_box, point()};
    const world::Trace trace = world::clip_move_to_model(map, model, point(), move);
    FB_CHECK(trace.fraction >= 0.0f && trace.fraction <= 1.0f);
    FB_CHECK(!(std::fabs(reach) < 1e8f && std::fabs(size_of_box.x) < 1e8f) || trace.end_pos == trace.end_pos);
    FB_CHECK(!trace.all_solid || trace.start_solid || trace.fraction < 1.0f);
    FB_CHECK(world::sv_point_contents(map, move.start) < 0);
    FB_CHECK_LT(world::pvs_leaf(*bsp, move.start), bsp->leafs.size());
    const world::LeafSet fat = world::fat_pvs(*bsp, move.start);
    const world::TouchedLeafs touched = world::touched_leafs(*bsp, world::move_bounds(move));
    FB_CHECK_LE(touched.count, world::TouchedLeafs::kMost);
    (void)touched.visible_in(fat);
  }
  return 0;
}
