// Frames that are begun before the former one is finished: the same pictures, each shown once, and in order.
#include <gtest/gtest.h>

#include <new>

#include "gpu/test_failures.h"
#include "render/renderer.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kColumns = 24, kRows = 16;
using Picture = std::vector<std::uint32_t>;

class FramesAheadTest : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    settings.estimator = "nee";
    settings.denoise = 1;
    settings.accumulate = 0;
  }
  // Each of its own: things move.
  static scene::FrameSnapshot frame(std::uint64_t number) {
    static const auto assets = scene::moving_assets();
    const double time = 0.05 * static_cast<double>(number);
    scene::FrameSnapshot snapshot = scene::moving(assets, time, time - 0.05);
    snapshot.frame = number;
    return snapshot;
  }
  RenderSettings settings;
};

TEST_F(FramesAheadTest, PicturesAreThoseOfFramesThatAreWaitedFor) {
  constexpr std::uint64_t kFrames = 6;
  std::vector<Picture> waited, ahead;
  auto renderer = make_renderer(settings, kColumns, kRows);
  for (std::uint64_t i = 0; i < kFrames; ++i) {
    renderer->render(frame(i), nullptr, settings);
    waited.push_back(renderer->read().output());
  }
  renderer = make_renderer(settings, kColumns, kRows);
  renderer->set_finished([&] { ahead.push_back(renderer->read().output()); });
  for (std::uint64_t i = 0; i < kFrames; ++i) {
    renderer->begin(frame(i), nullptr, settings);
    EXPECT_EQ(ahead.size(), i);  // each is shown before the next is begun
  }
  renderer->finish();
  renderer->finish();
  EXPECT_EQ(ahead, waited);
  EXPECT_NE(waited[0], waited[kFrames - 1]);
}

TEST_F(FramesAheadTest, AFrameIsShownAtItsOwnSizeWhereTheNextIsLarger) {
  auto renderer = make_renderer(settings, kColumns, kRows);
  std::vector<std::size_t> sizes;
  renderer->set_finished([&] { sizes.push_back(renderer->read().output().size()); });
  renderer->begin(frame(0), nullptr, settings);
  renderer->resize(2 * kColumns, kRows);
  renderer->begin(frame(1), nullptr, settings);
  renderer->resize(kColumns, 2 * kRows);
  ASSERT_TRUE(renderer->fit(settings));
  EXPECT_EQ(sizes, (std::vector<std::size_t>{kColumns * kRows, 2 * kColumns * kRows}));
}

// Another estimator, another level, and the end, each while a frame is under way: the validation layers watch.
TEST_F(FramesAheadTest, WhatIsInUseIsNotTakenAway) {
  auto renderer = make_renderer(settings, kColumns, kRows);
  for (const char* estimator : {"mcpg", "nee", "pt", "mcpg"}) {
    settings.estimator = estimator;
    renderer->begin(frame(0), nullptr, settings);
  }
  renderer->begin(scene::cornell_box(), nullptr, settings);
  renderer->begin(scene::many_lights(50), nullptr, settings);
  renderer.reset();
}

TEST_F(FramesAheadTest, AFrameThatFailsLeavesTheNextAsGoodAsAny) {
  auto renderer = make_renderer(settings, kColumns, kRows);
  int shown = 0;
  renderer->set_finished([&] { ++shown; });
  renderer->begin(frame(0), nullptr, settings);
  {
    const gpu::FailingCall failing(0);
    EXPECT_THROW(renderer->begin(scene::many_lights(400), nullptr, settings), std::bad_alloc);
  }
  renderer->render(frame(1), nullptr, settings);
  EXPECT_GE(shown, 1);
  auto fresh = make_renderer(settings, kColumns, kRows);
  fresh->render(frame(1), nullptr, settings);
  EXPECT_EQ(renderer->read().linear(), fresh->read().linear());
}

}  // namespace
}  // namespace fb::render
