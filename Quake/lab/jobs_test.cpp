// Frames of scenes in code: files, and sentences for what cannot be done.
#include "lab/jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/test_directory.h"
#include "lab/client_source.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

class JobsTest : public render::DeviceTest {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  static std::unique_ptr<FrameSource> scene(const std::string& name) {
    auto source = code_scene(name, 60);
    EXPECT_TRUE(source.ok());
    return std::move(*source);
  }
  const TestDirectory directory_;
};

TEST_F(JobsTest, WritesTheChosenFramesAndNoOthers) {
  auto renderer = make_renderer({}, 32, 18);
  RenderJob job;
  job.first = 2;
  job.last = 4;
  job.width = 32;
  job.height = 18;
  job.out = path("frames");
  job.quiet = true;
  const auto summary = render_frames(*scene("moving"), *renderer, {}, job);
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->frames, 3u);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(job.out))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"frame_000002.png", "frame_000003.png", "frame_000004.png"}));
}

TEST_F(JobsTest, RefusesWhatCannotBe) {
  EXPECT_NE(code_scene("nowhere", 60).error().message.find("cbox"), std::string::npos) << "names what there is";
  auto renderer = make_renderer({}, 8, 8);
  RenderJob job;
  job.first = 5;
  job.last = 2;
  EXPECT_FALSE(render_frames(*scene("cbox"), *renderer, {}, job).ok());
}

}  // namespace
}  // namespace fb::lab
