#include "world/area_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "base/rng.h"

namespace fb::world {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;

Bounds box(const vec3& min, const vec3& max) { return {min, max}; }
const Bounds kEverywhere = box(vec3(-1e6f), vec3(1e6f));

std::vector<int> found(const AreaNodes& areas, const Bounds& where, AreaList list = AreaList::kSolid) {
  std::vector<int> ids;
  areas.collect(list, where, ids);
  return ids;
}

// 1024 along x, 512 along y: cut at x = 0, then the halves (512 by 512) at y = 0, as x is not longer.
AreaNodes world() { return {vec3(-512, -256, -100), vec3(512, 256, 100)}; }

TEST(AreaNodes, ListsAreInOrderOfLinking) {
  AreaNodes areas = world();
  const Bounds middle = box(vec3(-1), vec3(1));
  for (const int id : {5, 2, 9}) areas.link(id, AreaList::kSolid, middle);
  EXPECT_THAT(found(areas, kEverywhere), ElementsAre(5, 2, 9));
  areas.link(5, AreaList::kSolid, middle);
  EXPECT_THAT(found(areas, kEverywhere), ElementsAre(2, 9, 5)) << "linked anew: last";
  areas.unlink(9);
  areas.unlink(9);
  EXPECT_FALSE(areas.linked(9));
  EXPECT_TRUE(areas.linked(5));
  EXPECT_FALSE(areas.linked(1000));
  EXPECT_THAT(found(areas, kEverywhere), ElementsAre(2, 5));
  areas.link(2, AreaList::kTrigger, middle);
  EXPECT_THAT(found(areas, kEverywhere), ElementsAre(5));
  EXPECT_THAT(found(areas, kEverywhere, AreaList::kTrigger), ElementsAre(2));
}

TEST(AreaNodes, NodeFirstThenAboveThenBelow) {
  AreaNodes areas = world();
  areas.link(1, AreaList::kSolid, box({-300, -200, 0}, {-290, -190, 0}));  // low x, low y
  areas.link(2, AreaList::kSolid, box({-300, 190, 0}, {-290, 200, 0}));    // low x, high y
  areas.link(3, AreaList::kSolid, box({290, -200, 0}, {300, -190, 0}));    // high x, low y
  areas.link(4, AreaList::kSolid, box({290, 190, 0}, {300, 200, 0}));      // high x, high y
  areas.link(5, AreaList::kSolid, box({-5, 0, 0}, {5, 0, 0}));             // across x = 0
  areas.link(6, AreaList::kSolid, box({100, -5, 0}, {110, 5, 0}));         // high x, across y = 0
  EXPECT_THAT(found(areas, kEverywhere), ElementsAre(5, 6, 4, 3, 2, 1));
}

TEST(AreaNodes, GoesOnlyWhereTheBoxReaches) {
  AreaNodes areas = world();
  areas.link(1, AreaList::kSolid, box({-300, 0, 0}, {-290, 0, 0}));
  areas.link(2, AreaList::kSolid, box({290, 0, 0}, {300, 0, 0}));
  areas.link(3, AreaList::kSolid, box({-5, 0, 0}, {5, 0, 0}));
  EXPECT_THAT(found(areas, box({1, -5, 0}, {2, 5, 0})), ElementsAre(3, 2));
  EXPECT_THAT(found(areas, box({-2, -5, 0}, {-1, 5, 0})), ElementsAre(3, 1));
  EXPECT_THAT(found(areas, box({0, -5, 0}, {0, 5, 0})), ElementsAre(3)) << "what only touches the cut is on no side";
  // A thing that only touches the cut from one side hangs at the cut.
  areas.link(4, AreaList::kSolid, box({0, 0, 0}, {5, 0, 0}));
  EXPECT_THAT(found(areas, box({-2, -5, 0}, {-1, 5, 0})), ElementsAre(3, 4, 1));
}

TEST(AreaNodes, VisitStops) {
  AreaNodes areas = world();
  for (int id = 0; id < 10; ++id) areas.link(id, AreaList::kSolid, box({id * 20.0f, 0, 0}, {id * 20.0f + 1, 0, 0}));
  int seen = 0;
  EXPECT_FALSE(areas.visit(AreaList::kSolid, kEverywhere, [&](int) { return ++seen < 4; }));
  EXPECT_EQ(seen, 4);
}

// Against a plain list: what meets a box is always among what is found, in whatever was linked and unlinked.
TEST(AreaNodes, NeverMissesWhatMeetsTheBox) {
  Rng rng(3);
  AreaNodes areas(vec3(-1000, -700, -300), vec3(900, 1200, 300));
  std::vector<std::optional<Bounds>> boxes(200);
  std::size_t least = boxes.size();
  for (int step = 0; step < 5000; ++step) {
    const auto id = rng.below(200);
    const vec3 at(rng.uniform(-1100, 1000), rng.uniform(-800, 1300), rng.uniform(-400, 400));
    const Bounds near = box(at - vec3(rng.uniform(0, 60)), at + vec3(rng.uniform(0, 60)));
    if (rng.below(5) == 0) {
      areas.unlink(static_cast<int>(id));
      boxes[id].reset();
    } else {
      areas.link(static_cast<int>(id), AreaList::kSolid, near);
      boxes[id] = near;
    }
    const std::vector<int> ids = found(areas, near);
    least = std::min(least, ids.size());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const auto times = std::ranges::count(ids, static_cast<int>(k));
      ASSERT_LE(times, boxes[k] ? 1 : 0);
      const bool meets = boxes[k] && boxes_meet(*boxes[k], near);
      ASSERT_TRUE(!meets || times == 1) << step;
    }
    std::vector<int> all;
    for (std::size_t k = 0; k < boxes.size(); ++k)
      if (boxes[k]) all.push_back(static_cast<int>(k));
    if (step % 100 == 0) {
      ASSERT_THAT(found(areas, kEverywhere), UnorderedElementsAreArray(all));
    }
  }
  EXPECT_LT(least, 40u) << "and not simply everything";
}

TEST(AreaNodes, BoxesThatAreNotNumbers) {
  AreaNodes areas = world();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  areas.link(1, AreaList::kSolid, box(vec3(nan), vec3(nan)));
  EXPECT_THAT(found(areas, box(vec3(5), vec3(6))), ElementsAre(1));
  areas.unlink(1);
  EXPECT_THAT(found(areas, box(vec3(nan), vec3(nan))), IsEmpty());
}

TEST(BoxesMeet, TouchingCounts) {
  EXPECT_TRUE(boxes_meet(box(vec3(0), vec3(1)), box(vec3(1), vec3(2))));
  EXPECT_FALSE(boxes_meet(box(vec3(0), vec3(1)), box(vec3(0, 0, 1.01f), vec3(2))));
}

}  // namespace
}  // namespace fb::world
