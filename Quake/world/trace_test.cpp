// Traces against values worked out by hand, and against brute force: contents asked at many points of the line.
#include "world/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/test_bsp.h"
#include "world/test_hulls.h"

namespace fb::world {
namespace {

using formats::kContentsEmpty;
using formats::kContentsSolid;
using formats::kContentsWater;
using testing::axial;
using testing::OwnedHull;

// Solid below z = 0, water up to 10, empty above.
OwnedHull pool() { return {{axial(2, 10, kContentsEmpty, 1), axial(2, 0, kContentsWater, kContentsSolid)}, 0}; }

TEST(TraceHull, StopsOneThirtySecondBeforeThePlane) {
  const OwnedHull floor{{axial(2, 0, kContentsEmpty, kContentsSolid)}, 0};
  const Trace trace = trace_hull(floor.hull(), {3, 4, 100}, {3, 4, -100});
  EXPECT_EQ(trace.fraction, 0.49984375f);  // (100 - 1/32) / 200
  EXPECT_EQ(trace.end_pos, vec3(3, 4, 0.03125f));
  EXPECT_EQ(trace.plane.normal, vec3(0, 0, 1));
  EXPECT_EQ(trace.plane.distance, 0.0f);
  EXPECT_FALSE(trace.start_solid);
  EXPECT_FALSE(trace.all_solid);
  EXPECT_TRUE(trace.in_open);
  EXPECT_FALSE(trace.in_water);
}

// The distance is measured along the normal, so a flat line stops further before.
TEST(TraceHull, EpsilonIsAlongTheNormal) {
  const OwnedHull wall{{axial(0, 64, kContentsSolid, kContentsEmpty)}, 0};
  const Trace trace = trace_hull(wall.hull(), {0, 0, 0}, {128, 1280, 0});
  EXPECT_EQ(trace.fraction, (-64.0 + 0.03125) / -128.0);
  EXPECT_EQ(trace.end_pos.x, 63.96875f);
  EXPECT_EQ(trace.end_pos.y, 639.6875f);
  EXPECT_EQ(trace.plane.normal, vec3(-1, 0, 0)) << "towards the start";
  EXPECT_EQ(trace.plane.distance, -64.0f);
  EXPECT_FALSE(std::signbit(trace.plane.normal.y)) << "no negative zeros";
}

TEST(TraceHull, FreeWay) {
  const Trace trace = trace_hull(pool().hull(), {0, 0, 20}, {5, 5, 11});
  EXPECT_EQ(trace.fraction, 1.0f);
  EXPECT_EQ(trace.end_pos, vec3(5, 5, 11));
  EXPECT_FALSE(trace.all_solid);
  EXPECT_TRUE(trace.in_open);
  EXPECT_FALSE(trace.in_water);
}

TEST(TraceHull, WaterIsNoObstacle) {
  const Trace trace = trace_hull(pool().hull(), {0, 0, 20}, {0, 0, -20});
  EXPECT_NEAR(trace.end_pos.z, 0.03125f, 1e-6);
  EXPECT_TRUE(trace.in_open);
  EXPECT_TRUE(trace.in_water);
}

TEST(TraceHull, StartOnThePlaneGoesNowhere) {
  const OwnedHull floor{{axial(2, 0, kContentsEmpty, kContentsSolid)}, 0};
  for (const float z : {0.0f, 0.01f, 0.03125f}) {
    const Trace trace = trace_hull(floor.hull(), {0, 0, z}, {0, 0, -8});
    EXPECT_EQ(trace.fraction, 0.0f) << z;
    EXPECT_EQ(trace.end_pos, vec3(0, 0, z));
    EXPECT_FALSE(trace.start_solid);
  }
}

TEST(TraceHull, InSolid) {
  const OwnedHull floor{{axial(2, 0, kContentsEmpty, kContentsSolid)}, 0};
  const Trace inside = trace_hull(floor.hull(), {0, 0, -5}, {0, 0, -9});
  EXPECT_TRUE(inside.all_solid);
  EXPECT_TRUE(inside.start_solid);
  EXPECT_EQ(inside.fraction, 1.0f);
  EXPECT_EQ(inside.end_pos, vec3(0, 0, -9));
  const Trace out = trace_hull(floor.hull(), {0, 0, -5}, {0, 0, 9});
  EXPECT_FALSE(out.all_solid);
  EXPECT_TRUE(out.start_solid);
  EXPECT_TRUE(out.in_open);
  EXPECT_EQ(out.fraction, 1.0f);
}

// Out of one solid, through the open, into another: the second is hit.
TEST(TraceHull, LeavesSolidAndHits) {
  const OwnedHull slot{{axial(0, 0, 1, kContentsSolid), axial(0, 10, kContentsSolid, kContentsEmpty)}, 0};
  const Trace trace = trace_hull(slot.hull(), {-10, 0, 0}, {20, 0, 0});
  EXPECT_TRUE(trace.start_solid);
  EXPECT_FALSE(trace.all_solid);
  EXPECT_NEAR(trace.end_pos.x, 10 - 0.03125f, 1e-5);
  // Through solid alone, over a plane with solid on both sides: never out.
  const OwnedHull rock{{axial(0, 0, kContentsSolid, kContentsSolid)}, 0};
  const Trace through = trace_hull(rock.hull(), {-10, 0, 0}, {20, 0, 0});
  EXPECT_TRUE(through.all_solid);
  EXPECT_EQ(through.fraction, 1.0f);
}

TEST(TraceHull, OfOneContents) {
  const Trace empty = trace_hull({}, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(empty.fraction, 1.0f);
  EXPECT_TRUE(empty.in_open);
  const Trace solid = trace_hull({{}, kContentsSolid, {}, {}}, {0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(solid.all_solid);
}

TEST(TraceHull, NotFiniteStays) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {infinity, -infinity, nan}) {
    const Trace trace = trace_hull(pool().hull(), {1, 2, 30}, {bad, 0, 0});
    EXPECT_TRUE(trace.all_solid && trace.start_solid);
    EXPECT_EQ(trace.fraction, 0.0f);
    EXPECT_EQ(trace.end_pos, vec3(1, 2, 30));
    EXPECT_TRUE(trace_hull(pool().hull(), {0, bad, 0}, {1, 2, 30}).all_solid);
  }
  const float huge = std::numeric_limits<float>::max();
  EXPECT_TRUE(trace_hull(pool().hull(), vec3(huge), vec3(-huge)).all_solid) << "their difference is not finite";
  EXPECT_FALSE(trace_hull(pool().hull(), {0, 0, 1e9f}, {0, 0, -1e9f}).all_solid);
}

// A map's normals may have any length.
TEST(TraceHull, PlanesThatAreNoPlanes) {
  const float huge = std::numeric_limits<float>::max();
  for (const float length : {0.0f, 1e-30f, 1e30f, huge}) {
    OwnedHull owned = pool();
    for (HullNode& node : owned.nodes) {
      node.type = 5;
      node.normal = vec3(length, -length, length);
      node.distance = length;
    }
    const Trace trace = trace_hull(owned.hull(), {1e8f, 0, 7}, {-1e8f, 5, -7});
    EXPECT_TRUE(trace.fraction >= 0.0f && trace.fraction <= 1.0f) << length;
    EXPECT_TRUE(std::isfinite(trace.end_pos.x)) << length;
  }
}

// Where keeping 1/32 off a plane puts the end back into solid, it is drawn back by tenths of the piece: here out of the
// solid below 0 into a gap of 1/100, whose far side is hit from a place that is still below 0.
TEST(TraceHull, DrawsBackOutOfSolid) {
  const OwnedHull gap{{axial(0, 0, 1, kContentsSolid), axial(0, 0.01f, kContentsSolid, kContentsEmpty)}, 0};
  const Trace trace = trace_hull(gap.hull(), {-10, 0, 0}, {0.02f, 0, 0});
  EXPECT_TRUE(trace.start_solid);
  EXPECT_FALSE(trace.all_solid);
  // The last piece goes from -0.03125 to 0.02, its hit is at 0.195 of it, one tenth back is solid too, two are before
  // it.
  EXPECT_NEAR(trace.end_pos.x, -0.03125f + 0.0951f * 0.05125f, 1e-5);
}

// As deep as a map may be, with every plane crossed; and with both children of every node the same one.
TEST(TraceHull, DeepHulls) {
  OwnedHull deep;
  constexpr auto kDepth = static_cast<std::int32_t>(formats::kMaxBspDepth);
  for (std::int32_t i = 0; i < kDepth; ++i) {
    const std::int32_t next = i + 1 < kDepth ? i + 1 : static_cast<std::int32_t>(kContentsEmpty);
    deep.nodes.push_back(axial(0, static_cast<float>(i - kDepth), next, kContentsEmpty));
  }
  const vec3 low(-2.0f * kDepth, 0, 0), high(10, 1, 0);
  EXPECT_EQ(trace_hull(deep.hull(), low, high).fraction, 1.0f);
  EXPECT_EQ(trace_hull(deep.hull(), high, low).fraction, 1.0f);
  for (HullNode& node : deep.nodes) node.children[1] = node.children[0];
  EXPECT_EQ(trace_hull(deep.hull(), high, low).fraction, 1.0f);
}

// More planes across a line than any map has: it ends where its work does.
TEST(TraceHull, WorkIsBounded) {
  OwnedHull fence;
  const auto grow = [&](auto&& self, int from, int to) -> std::int32_t {
    if (from == to) return kContentsEmpty;
    const int middle = (from + to) / 2;
    const auto index = fence.nodes.size();
    fence.nodes.push_back(axial(0, 0.25f * static_cast<float>(middle), 0, 0));
    const std::int32_t front = self(self, middle + 1, to), back = self(self, from, middle);
    fence.nodes[index].children = {front, back};
    return static_cast<std::int32_t>(index);
  };
  fence.first = grow(grow, 0, 2 * kMaxTraceSplits);
  const float length = 0.5f * kMaxTraceSplits;
  const Trace trace = trace_hull(fence.hull(), {-1, 0, 0}, {length, 0, 0});
  EXPECT_NEAR(trace.fraction, 0.5f, 0.05f);
  EXPECT_NEAR(trace.end_pos.x, 0.5f * length, 0.05f * length);
  EXPECT_FALSE(trace.all_solid);
}

// --- against brute force ---

// Contents all around a point, a little further than the epsilon that traces keep.
bool solid_around(const Hull& hull, const vec3& p, float reach) {
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 d((corner & 1) != 0 ? reach : -reach, (corner & 2) != 0 ? reach : -reach,
                 (corner & 4) != 0 ? reach : -reach);
    if (hull_point_contents(hull, p + d) != kContentsSolid) return false;
  }
  return hull_point_contents(hull, p) == kContentsSolid;
}

TEST(TraceHull, AgreesWithContentsAlongTheLine) {
  Rng rng(42);
  int hits = 0, free_ways = 0, started_solid = 0, ends_in_solid = 0;
  for (int world = 0; world < 200; ++world) {
    const OwnedHull owned = testing::random_hull(rng, 1 + world % 8);
    const Hull hull = owned.hull();
    for (int line = 0; line < 100; ++line) {
      const vec3 start = testing::random_point(rng, 250.0f), end = testing::random_point(rng, 250.0f);
      const Trace trace = trace_hull(hull, start, end);
      ASSERT_GE(trace.fraction, 0.0f);
      ASSERT_LE(trace.fraction, 1.0f);
      const float length = glm::length(end - start);
      ASSERT_LT(glm::length(start + trace.fraction * (end - start) - trace.end_pos), 1e-2f);
      if (trace.all_solid) {
        ASSERT_TRUE(trace.start_solid);
        ASSERT_EQ(hull_point_contents(hull, start), kContentsSolid);
        continue;
      }
      if (hull_point_contents(hull, start) == kContentsSolid) {
        ++started_solid;
        continue;
      }
      // Nothing truly solid up to where it stopped.
      for (float s = 0.0f; s < trace.fraction; s += 0.5f / length)
        ASSERT_FALSE(solid_around(hull, start + s * (end - start), 0.1f)) << "world " << world << " line " << line;
      if (trace.fraction == 1.0f) {
        ++free_ways;
        ASSERT_FALSE(solid_around(hull, end, 0.1f));
        continue;
      }
      ++hits;
      if (hull_point_contents(hull, trace.end_pos) == kContentsSolid) ++ends_in_solid;
      // It ends before the plane that it names, and behind that plane is something solid.
      const float distance = glm::dot(trace.plane.normal, trace.end_pos) - trace.plane.distance;
      EXPECT_GT(distance, -1e-3f);
      const vec3 beyond = trace.end_pos - trace.plane.normal * (distance + 0.02f);
      const vec3 deeper =
          trace.end_pos +
          (end - start) *
              (1e-4f + 2.0f * distance / std::fmax(1e-3f, std::fabs(glm::dot(trace.plane.normal, end - start))));
      EXPECT_TRUE(hull_point_contents(hull, beyond) == kContentsSolid ||
                  hull_point_contents(hull, deeper) == kContentsSolid)
          << "world " << world << " line " << line;
      EXPECT_LE(glm::dot(trace.plane.normal, end - start), 0.0f) << "the plane looks towards the start";
    }
  }
  EXPECT_GT(hits, 3000);
  EXPECT_GT(free_ways, 500);
  EXPECT_GT(started_solid, 1000);
  EXPECT_LT(ends_in_solid, hits / 500) << "only where it could not be drawn back far enough";
}

// --- boxes ---

TEST(ClipMove, ModelWithHullAndOffset) {
  const formats::Bsp bsp = formats::testing::box_room(formats::BspVersion::kBsp29);
  const MapHulls map(bsp);  // every hull is the room itself, -128 to 128
  // A box as wide as a player, but with its corner elsewhere: clipped as if it were the player's box in the same
  // corner.
  const Move move{{0, 0, 0}, {0, 0, 0}, {32, 32, 56}, {0, 0, -500}};
  const Trace trace = clip_move_to_model(map, 0, {0, 0, 0}, move);
  // Local start: 0 - (-24 - 0) = 24, down to -128.
  EXPECT_NEAR(trace.end_pos.z, -128 - 24 + 0.03125f, 1e-4);
  // The model moved by 100 stops it 100 higher.
  EXPECT_NEAR(clip_move_to_model(map, 0, {0, 0, 100}, move).end_pos.z, -52 + 0.03125f, 1e-4);
  // A point.
  EXPECT_NEAR(clip_move_to_model(map, 0, {7, 8, 100}, {{0, 0, 100}, {}, {}, {0, 0, -500}}).end_pos.z, -28 + 0.03125f,
              1e-4);
}

TEST(ClipMove, FreeWayEndsExactlyThere) {
  const Move move{{0.1f, 0, 0}, {-16, -16, -24}, {16, 16, 32}, {0.3f, 0.7f, 1e-3f}};
  const Trace trace = clip_move_to_box({4000.3f, 100.1f, 0}, vec3(-1), vec3(1), move);
  EXPECT_EQ(trace.end_pos, move.end);
  EXPECT_EQ(trace.fraction, 1.0f);
}

TEST(ClipMove, BoxAgainstBox) {
  const Move move{{0, 0, 0}, {-8, -8, -8}, {8, 8, 8}, {100, 0, 0}};
  const Trace trace = clip_move_to_box({50, 0, 0}, {-10, -10, -10}, {10, 10, 10}, move);
  EXPECT_NEAR(trace.end_pos.x, 50 - 10 - 8 - 0.03125f, 1e-4);
  EXPECT_EQ(trace.plane.normal, vec3(-1, 0, 0));
  const Trace inside = clip_move_to_box({0, 0, 0}, {-10, -10, -10}, {10, 10, 10}, {{}, {}, {}, {1, 1, 1}});
  EXPECT_TRUE(inside.all_solid);
  const Trace beside = clip_move_to_box({50, 40, 0}, {-10, -10, -10}, {10, 10, 10}, move);
  EXPECT_EQ(beside.fraction, 1.0f);
}

TEST(MoveBounds, IsAUnitWider) {
  const Bounds bounds = move_bounds({{0, 10, 5}, {-1, -2, -3}, {4, 5, 6}, {100, -10, 5}});
  EXPECT_EQ(bounds.min, vec3(-2, -13, 1));
  EXPECT_EQ(bounds.max, vec3(105, 16, 12));
}

TEST(MergeTrace, NearestWinsAndStartSolidStays) {
  Trace world;
  world.fraction = 0.5f;
  world.start_solid = true;
  Trace further;
  further.fraction = 0.6f;
  EXPECT_FALSE(merge_trace(world, further));
  Trace equal;
  equal.fraction = 0.5f;
  EXPECT_FALSE(merge_trace(world, equal)) << "the first one stays";
  Trace nearer;
  nearer.fraction = 0.4f;
  EXPECT_TRUE(merge_trace(world, nearer));
  EXPECT_EQ(world.fraction, 0.4f);
  EXPECT_TRUE(world.start_solid);
  Trace starts;  // free after all, but it was in something
  starts.start_solid = true;
  EXPECT_TRUE(merge_trace(world, starts));
  EXPECT_EQ(world.fraction, 1.0f) << "as in Quake: what it started in counts more than what was hit";
}

}  // namespace
}  // namespace fb::world
