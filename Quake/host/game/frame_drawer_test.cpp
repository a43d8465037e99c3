#include "host/game/frame_drawer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>

#include "base/log.h"
#include "gpu/test_failures.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::host {
namespace {

using testing::HasSubstr;

class FrameDrawerTest : public render::DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (!device_) return;
    settings.accumulate = 0;
    renderer = make_renderer(settings, 16, 16);
    drawer.emplace(*renderer);
    drawer->resize({16, 16});
    listener = add_log_listener([this](LogLevel level, std::string_view line) {
      if (level == LogLevel::kError) errors.emplace_back(line);
    });
  }
  void TearDown() override {
    if (listener != 0) remove_log_listener(listener);
    drawer.reset();
    renderer.reset();
    DeviceTest::TearDown();
  }
  uvec2 drawn_size(const render::RenderSettings& wanted) {
    drawer->draw(snapshot, nullptr, wanted);
    EXPECT_EQ(renderer->read().linear().size(), std::size_t{renderer->render_size().x} * renderer->render_size().y);
    EXPECT_EQ(drawer->size(wanted), renderer->output_size());
    return renderer->output_size();
  }

  scene::FrameSnapshot snapshot = scene::cornell_box();
  render::RenderSettings settings;
  std::unique_ptr<render::Renderer> renderer;
  std::optional<FrameDrawer> drawer;
  std::vector<std::string> errors;
  int listener = 0;
};

TEST_F(FrameDrawerTest, KeepsTheSizeWhereALargerOneDoesNotFitAndSaysSoOnce) {
  EXPECT_EQ(drawn_size(settings), uvec2(16, 16));
  drawer->resize({1u << 20u, 1u << 20u});
  for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(drawn_size(settings), uvec2(16, 16));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_THAT(errors[0], HasSubstr("1048576x1048576"));
  drawer->resize({24, 8});
  EXPECT_EQ(drawn_size(settings), uvec2(24, 8));
  EXPECT_EQ(errors.size(), 1u);
}

TEST_F(FrameDrawerTest, KeepsTheSettingsWhereThereIsNoMemoryForOthers) {
  drawn_size(settings);
  const auto before = renderer->read().linear();
  render::RenderSettings learns = settings;
  learns.estimator = "mcpg";
  {
    const gpu::FailingCall failing(0);
    drawer->draw(snapshot, nullptr, learns);
    EXPECT_FALSE(failing.failed().empty());
  }
  EXPECT_EQ(renderer->read().linear(), before);
  EXPECT_EQ(renderer->learnt_bytes(), 0u);
  drawer->draw(snapshot, nullptr, learns);  // not tried again
  EXPECT_EQ(renderer->learnt_bytes(), 0u);
  EXPECT_EQ(errors.size(), 1u);
  drawer->draw(snapshot, nullptr, settings);
  drawer->draw(snapshot, nullptr, learns);  // something else was asked for in between
  EXPECT_GT(renderer->learnt_bytes(), 0u);
  EXPECT_EQ(errors.size(), 1u);
}

TEST_F(FrameDrawerTest, ThrowsWhereNothingWasDrawnYetOrTheSceneDoesNotFit) {
  {
    const gpu::FailingCall failing(0);
    EXPECT_THROW(drawer->draw(snapshot, nullptr, settings), std::bad_alloc);
  }
  drawn_size(settings);
  {
    const gpu::FailingCall failing(0);
    const auto larger = scene::many_lights(20);
    EXPECT_THROW(drawer->draw(larger, nullptr, settings), std::bad_alloc);
  }
  EXPECT_TRUE(errors.empty());
  drawn_size(settings);
}

}  // namespace
}  // namespace fb::host
