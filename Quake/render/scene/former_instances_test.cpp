#include "render/scene/former_instances.h"

#include <gtest/gtest.h>

#include <vector>

#include "shared/scene_gpu.h"

namespace fb::render {
namespace {

using Places = std::vector<std::uint32_t>;
constexpr std::uint32_t kGone = shared::kNoIndex;

TEST(FormerInstances, FollowsThingsThroughTheTable) {
  FormerInstances instances;
  instances.begin_frame({{0, 5, false}, {7, 1, false}, {9, 1, false}});
  EXPECT_EQ(instances.places(), Places{}) << "there was no frame before";
  instances.begin_frame({{0, 5, false}, {9, 1, false}, {8, 1, true}, {7, 1, false}});
  EXPECT_EQ(instances.places(), (Places{0, 3, 1}));
  instances.begin_frame({{0, 5, false}, {8, 1, false}});
  EXPECT_EQ(instances.places(), (Places{0, kGone, 1, kGone}));
}

TEST(FormerInstances, AnotherMeshAndWhatIsNewAreOtherThings) {
  FormerInstances instances;
  instances.begin_frame({{1, 5, false}, {2, 5, false}, {3, 5, false}});
  instances.begin_frame({{1, 6, false}, {2, 5, true}, {3, 5, false}});
  EXPECT_EQ(instances.places(), (Places{kGone, kGone, 2}));
}

TEST(FormerInstances, ForgetsTheFormerFrame) {
  FormerInstances instances;
  instances.begin_frame({{1, 5, false}});
  instances.forget();
  instances.begin_frame({{1, 5, false}});
  EXPECT_EQ(instances.places(), Places{});
}

}  // namespace
}  // namespace fb::render
