// Every Vulkan call that may run out of memory does so once: while a device and a renderer start, in a first frame, and
// where size, settings or scene change in a running renderer. What is asked for fails with a sentence, nothing leaks,
// and what was drawn before is drawn again, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <new>
#include <optional>

#include "base/hash.h"
#include "base/log.h"
#include "base/out_of_memory.h"
#include "gpu/test_failures.h"
#include "render/picture/picture_size.h"
#include "render/renderer.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using testing::HasSubstr;

// What is drawn.
struct View {
  uvec2 size{24, 16};
  RenderSettings settings;
  scene::FrameSnapshot snapshot;
  scene::DrawList list;
};

View small_view(Intersector intersector) {
  View view;
  view.settings.intersector = intersector;
  view.settings.accumulate = 0;
  view.settings.first_spp = 1;  // with a history or without: the same samples
  view.snapshot = scene::cornell_box();
  return view;
}

scene::DrawList many_quads() {
  scene::DrawList list;
  auto atlas = std::make_shared<scene::DrawAtlas>();
  atlas->width = atlas->height = 64;
  atlas->texels.assign(64 * 64, 0xffffffffu);
  atlas->revision = 1;
  list.atlas = atlas;
  for (int i = 0; i < 700; ++i) list.quads.push_back({vec2(0.0f), vec2(64.0f), vec2(0.0f), vec2(1.0f), vec4(1.0f)});
  return list;
}

class OutOfMemoryTest : public testing::Test {
 protected:
  void SetUp() override {
    listener_ = add_log_listener([this](LogLevel, std::string_view line) {
      if (line.starts_with("Vulkan validation")) validation_ += std::string(line) + "\n";
    });
    set_log_level(LogLevel::kWarning);  // a guide is told of each time that it is made
    auto made = gpu::Device::create(options());
    if (!made) GTEST_SKIP() << "no Vulkan device: " << made.error().message;
    device_ = std::move(*made);
  }
  void TearDown() override {
    device_.reset();  // the layers tell now of what was not destroyed
    remove_log_listener(listener_);
    set_log_level(LogLevel::kInfo);
    EXPECT_EQ(validation_, "");
  }
  static gpu::DeviceOptions options() {
    gpu::DeviceOptions options;
    options.validation = true;
    options.shares_pipelines = false;  // each attempt makes them, and may fail at them
    return options;
  }
  std::vector<Intersector> intersectors() const {
    std::vector<Intersector> list{Intersector::kBvh};
    if (device_->has_ray_query()) list.push_back(Intersector::kQuery);
    return list;
  }

  static void draw(Renderer& renderer, const View& view) {
    renderer.resize(view.size.x, view.size.y);
    renderer.render(view.snapshot, &view.list, view.settings);
  }
  // Of one frame with nothing before it: what was traced. The denoiser's picture has a history; that it can be read and
  // has its size is enough.
  static std::uint64_t picture(Renderer& renderer, const View& view) {
    renderer.reset_learning();
    draw(renderer, view);
    EXPECT_EQ(renderer.read().denoised().size(), renderer.read().linear().size());
    const std::uint64_t size[] = {renderer.read().output().size(), renderer.learnt_bytes()};
    const auto linear = renderer.read().linear();
    return hash_span(std::span<const vec4>(linear), hash_span(std::span<const std::uint64_t>(size)));
  }

  // Draws with the nth call failing. False: there were not so many calls.
  bool draw_failing(Renderer& renderer, const View& view, std::size_t nth) {
    const gpu::FailingCall failing(nth);
    std::string sentence;
    try {
      draw(renderer, view);
    } catch (const std::bad_alloc& failure) {
      sentence = sentence_of(failure);
    }
    if (failing.failed().empty()) return false;
    ++failed_[failing.failed()];
    EXPECT_THAT(sentence, HasSubstr("out of memory")) << failing.failed();
    return true;
  }

  // Draws `from`, then `to`, with each call failing in turn. Both must come as ever: `from` where one goes back to it,
  // `to` where it is tried again at once.
  void expect_change_survives(Renderer& renderer, const View& from, const View& to, std::uint64_t looks_from,
                              std::uint64_t looks_to) {
    for (const bool goes_back : {true, false}) {
      draw(renderer, from);
      std::size_t failures = 0;
      while (draw_failing(renderer, to, failures)) {
        if (!goes_back) {
          ASSERT_EQ(picture(renderer, to), looks_to) << "after call " << failures;
        }
        ASSERT_EQ(picture(renderer, from), looks_from) << "after call " << failures;
        ++failures;
      }
      EXPECT_GT(failures, 5u);
      EXPECT_EQ(picture(renderer, to), looks_to);
    }
  }
  // There and back again.
  void expect_changes_survive(View a, View b) {
    for (const Intersector intersector : intersectors()) {
      a.settings.intersector = b.settings.intersector = intersector;
      auto reference = Renderer::create(*device_, a.settings), tested = Renderer::create(*device_, a.settings);
      ASSERT_TRUE(reference.ok() && tested.ok());
      const std::uint64_t looks_a = picture(**reference, a), looks_b = picture(**reference, b);
      expect_change_survives(**tested, a, b, looks_a, looks_b);
      expect_change_survives(**tested, b, a, looks_b, looks_a);
    }
  }

  std::unique_ptr<gpu::Device> device_;
  std::map<std::string, int> failed_;  // calls that failed, how often
  std::string validation_;
  int listener_ = 0;
};

TEST_F(OutOfMemoryTest, ADevicesStartFailsWithASentence) {
  std::size_t nth = 0;
  for (;; ++nth) {
    const gpu::FailingCall failing(nth);
    const auto device = gpu::Device::create(options());
    if (failing.failed().empty()) {
      EXPECT_TRUE(device.ok());
      break;
    }
    ASSERT_FALSE(device.ok()) << failing.failed();
    EXPECT_THAT(device.error().message, HasSubstr("OUT_OF_DEVICE_MEMORY")) << failing.failed();
  }
  EXPECT_GT(nth, 5u);
}

TEST_F(OutOfMemoryTest, ARenderersStartFailsWithASentenceAndGivesAllBack) {
  const std::uint64_t before = device_->allocated_bytes();
  for (const Intersector intersector : intersectors()) {
    const View view = small_view(intersector);
    std::map<std::string, int> failed;
    for (std::size_t nth = 0;; ++nth) {
      const gpu::FailingCall failing(nth);
      const Status started = [&]() -> Status {
        auto renderer = Renderer::create(*device_, view.settings);
        if (!renderer) return renderer.error();
        (*renderer)->resize(view.size.x, view.size.y);
        return (*renderer)->fit(view.settings);
      }();
      if (failing.failed().empty()) {
        EXPECT_TRUE(started.ok());
        break;
      }
      ++failed[failing.failed()];
      ASSERT_FALSE(started.ok()) << failing.failed();
      EXPECT_THAT(started.error().message, HasSubstr("out of memory")) << failing.failed();
    }
    // But for what the device keeps for itself.
    EXPECT_LE(device_->allocated_bytes(), before + (17u << 20u));
    for (const char* call :
         {"vkAllocateMemory", "vkMapMemory", "vkCreateBuffer", "vkBindBufferMemory", "vkCreateDescriptorPool",
          "vkAllocateDescriptorSets", "vkCreatePipelineLayout", "vkCreateDescriptorSetLayout", "vkCreateShaderModule",
          "vkCreateComputePipelines", "vkQueueSubmit", "vkWaitForFences"})
      EXPECT_GT(failed[call], 0) << call;
  }
}

// Pipelines are made when a pass first runs.
TEST_F(OutOfMemoryTest, AFirstFrameIsDrawnInTheEnd) {
  for (const Intersector intersector : intersectors()) {
    View view = small_view(intersector);
    std::uint64_t looks = 0;
    for (const char* function : {"vk", "vkCreateComputePipelines"}) {
      auto tried = Renderer::create(*device_, view.settings);
      ASSERT_TRUE(tried.ok());
      // The second pipeline that an attempt makes: the first is there when the next one begins, and so are those that
      // other threads were making.
      const bool pipelines = std::string_view(function) != "vk";
      std::size_t failures = 0;
      for (;; ++failures) {
        const gpu::FailingCall failing(pipelines ? 1 : failures, function);
        std::string sentence;
        try {
          draw(**tried, view);
        } catch (const std::bad_alloc& failure) {
          sentence = sentence_of(failure);
        }
        if (failing.failed().empty()) break;
        ASSERT_THAT(sentence, HasSubstr("out of memory")) << failing.failed();
      }
      EXPECT_GT(failures, pipelines ? 0u : 20u);
      const std::uint64_t now = picture(**tried, view);
      if (pipelines) {
        EXPECT_EQ(now, looks);
      }
      looks = now;
    }
  }
}

TEST_F(OutOfMemoryTest, AResizeThatFailsLeavesTheFormerSize) {
  const View from = small_view(Intersector::kBvh);
  View to = from;
  to.size = {61, 37};
  expect_changes_survive(from, to);
  for (const char* function :
       {"vkCreateBuffer", "vkAllocateMemory", "vkBindBufferMemory", "vkCreateBufferView", "vkBeginCommandBuffer",
        "vkEndCommandBuffer", "vkQueueSubmit", "vkWaitForFences", "vkResetFences", "vkGetQueryPoolResults"})
    EXPECT_GT(failed_[function], 0) << function;
}

TEST_F(OutOfMemoryTest, ASceneThatDoesNotFitLeavesTheFormerOne) {
  View from = small_view(Intersector::kBvh), to = from;
  to.snapshot = scene::many_lights(30);
  expect_changes_survive(from, to);
}

TEST_F(OutOfMemoryTest, AnEstimatorThatDoesNotFitLeavesTheFormerOne) {
  View from = small_view(Intersector::kBvh), to = from;
  to.settings.estimator = "mcpg";
  to.settings.deterministic = 1;
  to.settings.mc_states = 4096;
  to.settings.mc_cells = 4096;
  expect_changes_survive(from, to);
}

TEST_F(OutOfMemoryTest, ADenoiserThatDoesNotFitLeavesTheFormerPicture) {
  View from = small_view(Intersector::kBvh), to = from;
  to.settings.denoise = 1;
  to.settings.scale = 0.5f;
  to.list = many_quads();
  expect_changes_survive(from, to);
  from = to;
  to.size = {31, 40};
  expect_changes_survive(from, to);
  from.settings.denoise = 0;
  to = from;
  to.settings.denoise = 1;
  to.list = {};
  from.list = many_quads();
  expect_changes_survive(from, to);
}

TEST_F(OutOfMemoryTest, APictureBeyondTheDevicesLimitsIsRefusedBeforeAnythingIsMade) {
  View view = small_view(Intersector::kBvh);
  const uvec2 huge(1u << 20u, 1u << 20u);
  const uvec2 most = largest_output(device_->limits(), huge, view.settings);
  auto renderer = Renderer::create(*device_, view.settings);
  ASSERT_TRUE(renderer.ok());
  const std::uint64_t expected = picture(**renderer, view);
  (*renderer)->resize(huge.x, huge.y);
  const auto refused = (*renderer)->fit(view.settings);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("a picture of 1048576x1048576 needs a buffer of"));
  EXPECT_THAT(refused.error().message, HasSubstr(fmt::format("at most {}x{}", most.x, most.y)));
  EXPECT_EQ(picture(**renderer, view), expected);
}

TEST(PictureSize, TheLargestThatFitsDoesAndOneRowMoreDoesNot) {
  gpu::DeviceLimits limits;
  limits.max_storage_buffer_range = limits.max_allocation_bytes = 128u << 20u;
  for (const float scale : {1.0f, 0.37f}) {
    RenderSettings settings;
    settings.scale = scale;
    const auto bytes = [&](uvec2 output) {
      const uvec2 size = scaled_size(output, settings);
      return std::max(std::uint64_t{size.x} * size.y * sizeof(shared::GBufferTexel),
                      std::uint64_t{output.x} * output.y * 4);
    };
    for (const uvec2 wanted : {uvec2(16384, 16384), uvec2(16384, 1200), uvec2(3, 4000000000u)}) {
      const uvec2 most = largest_output(limits, wanted, settings);
      EXPECT_LE(bytes(most), 128u << 20u);
      EXPECT_GT(bytes(uvec2(most.x + 4, most.y + 4)), 128u << 20u) << most.x << "x" << most.y;
    }
    EXPECT_EQ(largest_output(limits, uvec2(640, 360), settings), uvec2(640, 360));
  }
}

// 128 MiB are what Mesa 22's lavapipe allows.
TEST(PictureSize, A720pPictureOfFogAndWaterFitsSmallBuffers) {
  gpu::DeviceLimits limits;
  limits.max_storage_buffer_range = limits.max_allocation_bytes = 128u << 20u;
  RenderSettings settings;
  settings.denoise = settings.taa = 1;
  const PictureParts all{sizeof(shared::GBufferTexel) / 16 + shared::kWaterPlanes, {4, 2}};
  EXPECT_EQ(largest_output(limits, uvec2(1280, 720), settings, all), uvec2(1280, 720));
  PictureParts dense = all;
  dense.blocks = {1, 1};
  EXPECT_NE(largest_output(limits, uvec2(1280, 720), settings, dense), uvec2(1280, 720));
}

}  // namespace
}  // namespace fb::render
