// Traces, areas and visibility on LibreQuake's maps. Skipped where the data is absent.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/librequake.h"
#include "base/rng.h"
#include "fs/filesystem.h"
#include "world/bsp_query.h"
#include "world/liquid_windows.h"
#include "world/pvs.h"
#include "world/trace.h"

namespace fb::world {
namespace {

class RealMaps : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string lacks = librequake_lacks("id1/pak1.pak"); !lacks.empty()) GTEST_SKIP() << lacks;
    fs::FsOptions options;
    options.base_dir = librequake_folder();
    options.user_dir = "";
    auto opened = fs::FileSystem::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files.emplace(std::move(*opened));
  }
  formats::Bsp load(std::string_view name) {
    const auto bytes = files->load(name);
    FB_CHECK(bytes.ok());
    auto bsp = formats::parse_bsp(*bytes, name);
    FB_CHECK(bsp.ok());
    return std::move(*bsp);
  }
  // A point in the world's box.
  static vec3 point_in(const formats::Bsp& bsp, Rng& rng) {
    const formats::BspModel& model = bsp.models[0];
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = rng.uniform(model.mins[axis], model.maxs[axis]);
    return p;
  }
  std::optional<fs::FileSystem> files;
};

constexpr const char* kMaps[] = {"maps/start.bsp", "maps/lq_e0m1.bsp", "maps/lq_e0m2.bsp", "maps/lq_e1m7.bsp",
                                 "maps/lqdm3.bsp"};

// Whoever moves from open space stays in open space: the hull never lets a trace end in solid but by a hair.
TEST_F(RealMaps, TracesEndInTheOpen) {
  for (const char* name : kMaps) {
    const formats::Bsp bsp = load(name);
    const MapHulls map(bsp);
    Rng rng(11);
    int moves = 0, hits = 0, ends_solid = 0;
    for (int i = 0; i < 60000; ++i) {
      const Hull hull = map.hull(0, i % kHullCount);
      const vec3 start = point_in(bsp, rng);
      vec3 end = point_in(bsp, rng);
      if (i % 2 == 0) end = start + (end - start) * 0.02f;
      const Trace trace = trace_hull(hull, start, end);
      const bool starts_solid = hull_point_contents(hull, start) == formats::kContentsSolid;
      ASSERT_TRUE(trace.fraction >= 0.0f && trace.fraction <= 1.0f);
      ASSERT_TRUE(starts_solid || !trace.all_solid);
      if (starts_solid) {
        ASSERT_TRUE(trace.start_solid);
        continue;
      }
      ++moves;
      if (trace.fraction < 1.0f) ++hits;
      if (hull_point_contents(hull, trace.end_pos) == formats::kContentsSolid) ++ends_solid;
    }
    EXPECT_GT(moves, 1000) << name;
    EXPECT_GT(hits, moves / 4) << name;
    EXPECT_LE(ends_solid, moves / 1000) << name;
  }
}

// The same map in three formats has the same hulls.
TEST_F(RealMaps, FormatsAgree) {
  const formats::Bsp bsp29 = load("maps/lq_e0m1.bsp");
  const MapHulls hulls29(bsp29);
  int compared = 0;
  for (const auto& found : files->find("maps/lq_e0m1", ".bsp")) {
    const formats::Bsp other = load(found.name);
    if (other.clip_nodes.size() != bsp29.clip_nodes.size()) continue;
    ++compared;
    const MapHulls hulls(other);
    ASSERT_EQ(hulls.model_count(), hulls29.model_count());
    Rng rng(5);
    for (int i = 0; i < 5000; ++i) {
      const vec3 start = point_in(bsp29, rng), end = point_in(bsp29, rng);
      const auto model = i % 4 == 0 ? rng.below(hulls.model_count()) : 0;
      const Trace a = trace_hull(hulls29.hull(model, i % 3), start, end);
      const Trace b = trace_hull(hulls.hull(model, i % 3), start, end);
      ASSERT_EQ(a.fraction, b.fraction) << found.name;
      ASSERT_EQ(a.end_pos, b.end_pos);
      ASSERT_EQ(a.plane.normal, b.plane.normal);
    }
  }
  EXPECT_GE(compared, 3);
}

TEST_F(RealMaps, LeafsHoldTheirPointsAndSeeThemselves) {
  for (const char* name : kMaps) {
    const formats::Bsp bsp = load(name);
    Rng rng(13);
    int open = 0;
    for (int i = 0; i < 20000; ++i) {
      const vec3 p = point_in(bsp, rng);
      const std::uint32_t leaf = pvs_leaf(bsp, p);
      if (bsp.leafs[leaf].contents == formats::kContentsSolid) continue;
      ++open;
      ASSERT_TRUE(leaf_pvs(bsp, leaf).contains(leaf)) << name;
      const LeafSet fat = fat_pvs(bsp, p);
      ASSERT_TRUE(fat.contains(leaf)) << name;
      const TouchedLeafs around = touched_leafs(bsp, {p - vec3(4), p + vec3(4)});
      ASSERT_GT(around.count, 0u);
      ASSERT_TRUE(around.visible_in(fat)) << name;
      ASSERT_EQ(fat.contains(leaf), leaf_visibility(bsp, leaf)[leaf]);
    }
    EXPECT_GT(open, 300) << name;
  }
}

// LibreQuake's visibility passes water, whose surfaces are many: nothing is parted there.
TEST_F(RealMaps, LiquidsHaveNoWindowsWhereVisibilityPassesThem) {
  for (const char* name : kMaps) EXPECT_EQ(LiquidWindows(load(name)).count(), 0u) << name;
}

}  // namespace
}  // namespace fb::world
