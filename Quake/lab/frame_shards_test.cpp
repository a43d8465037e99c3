// Frames split over machines are the same frames, and what is missing or double is named.
#include "lab/frame_shards.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "base/test_directory.h"
#include "lab/frame_source.h"
#include "lab/jobs.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

TEST(FramesOfShard, TakeEveryFrameOnce) {
  for (const std::uint32_t count : {1u, 2u, 3u, 7u}) {
    std::uint64_t next = 5;
    for (std::uint32_t index = 1; index <= count; ++index) {
      const auto [first, last] = frames_of_shard(5, 14, index, count);
      EXPECT_EQ(first, next);
      EXPECT_GE(last - first + 1, 10 / count);
      next = last + 1;
    }
    EXPECT_EQ(next, 15u);
  }
}

class FrameShardsTest : public render::DeviceTest {
 protected:
  std::string folder(const std::string& name) const { return directory_.file(name); }
  // Frames 2 to 6 of a scene that moves.
  void render(const std::string& name, std::uint32_t index, std::uint32_t count, std::uint64_t warmup = 0,
              const char* of = "moving") {
    render::RenderSettings settings;
    auto renderer = make_renderer(settings, 24, 16);
    RenderJob job;
    std::tie(job.first, job.last) = frames_of_shard(2, 6, index, count);
    job.warmup = warmup;
    job.width = 24;
    job.height = 16;
    job.out = folder(name);
    job.format = ImageFormat::kExr;
    job.quiet = true;
    auto source = code_scene("moving", 60);
    const auto summary = render_frames(**source, *renderer, settings, job);
    ASSERT_TRUE(summary.ok());
    EXPECT_EQ(summary->frames, job.last - job.first + 1) << "warming up is not counted";
    if (count > 1) {
      ASSERT_TRUE(tell_shard(job.out, {of, 2, 6, index, count}).ok());
    }
  }
  std::string bytes(const std::string& name, int frame) const {
    std::ifstream file(fmt::format("{}/frame_{:06}.exr", folder(name), frame), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  const TestDirectory directory_;
};

TEST_F(FrameShardsTest, JoinedTheyAreTheSame) {
  render("whole", 1, 1);
  render("a", 1, 2);
  render("b", 2, 2, 3);
  const auto merged = merge_frames({folder("b"), folder("a")}, folder("merged"));
  ASSERT_TRUE(merged.ok()) << merged.error().message;
  EXPECT_EQ(*merged, 5u);
  for (int frame = 2; frame <= 6; ++frame) {
    EXPECT_FALSE(bytes("whole", frame).empty());
    EXPECT_EQ(bytes("whole", frame), bytes("merged", frame)) << frame;
  }
  const auto refusal = [&](const std::vector<std::string>& names) {
    std::vector<std::string> folders;
    for (const std::string& name : names) folders.push_back(folder(name));
    const auto refused = merge_frames(folders, folder("refused"));
    EXPECT_FALSE(refused.ok());
    EXPECT_FALSE(std::filesystem::exists(folder("refused")));
    return refused ? "" : refused.error().message;
  };
  EXPECT_NE(refusal({"a"}).find("shard 2 of 2 is missing"), std::string::npos);
  EXPECT_NE(refusal({"a", "b", "a"}).find("shard 1 is there twice"), std::string::npos);
  EXPECT_NE(refusal({"a", "whole"}).find("frames.json"), std::string::npos) << "it was not a shard";
  render("other", 2, 2, 0, "another view");
  EXPECT_NE(refusal({"a", "other"}).find("another view"), std::string::npos);
  std::filesystem::remove(folder("b") + "/frame_000005.exr");
  EXPECT_NE(refusal({"a", "b"}).find("frame 5 is missing"), std::string::npos);
  EXPECT_NE(merge_frames({folder("a")}, folder("merged")).error().message.find("missing"), std::string::npos);
}

}  // namespace
}  // namespace fb::lab
