// References: closed forms, stated uncertainties, and that however they were made they are the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "lab/image_io.h"
#include "lab/reference/reference_job.h"
#include "lab/reference/replicates.h"
#include "lab/reference/test_reference.h"

namespace fb::lab {
namespace {

using ReferenceSequences = ReferenceTest;

render::RenderSettings repeatable(const char* estimator) {
  render::RenderSettings settings;
  settings.estimator = estimator;
  settings.deterministic = 1;
  return settings;
}

TEST(PlanBlocks, TakeEverySampleOnce) {
  for (const std::uint32_t spp : {1u, 17u, 255u, 256u, 511u, 512u, 900u, 2048u, 2600u, 100000u, 1u << 24u}) {
    std::uint32_t next = 0;
    const auto blocks = plan_blocks(spp);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      EXPECT_EQ(blocks[i].index, i);
      EXPECT_EQ(blocks[i].first, next);
      if (i + 1 < blocks.size()) {
        EXPECT_EQ(blocks[i].samples, block_samples(blocks[i].index)) << "whole, so that more go on";
      }
      next += blocks[i].samples;
    }
    EXPECT_EQ(next, spp);
    EXPECT_LT(blocks.size(), 200u);
  }
}

TEST(ReferenceSum, WeighsBlocksByTheirSamples) {
  const auto block = [](std::uint32_t index, std::uint32_t samples, float mean, float variance) {
    return ReferenceBlock{{index, 0, samples}, {Picture{1, 1, {vec3(mean)}}, {vec3(variance)}}};
  };
  ReferenceSum sum;
  sum.add(block(0, 100, 2.0f, 0.5f));
  sum.add(block(1, 300, 4.0f, 0.1f));
  EXPECT_EQ(sum.samples(), 400u);
  EXPECT_FLOAT_EQ(sum.reference().mean.pixels[0].x, 3.5f);
  EXPECT_FLOAT_EQ(sum.reference().variance[0].x, 0.5f / 16 + 0.1f * 9 / 16);
  EXPECT_NEAR(error_of(sum.reference()).relative, std::sqrt(0.5 / 16 + 0.9 / 16) / 3.5, 1e-6);
  sum.add({{2, 400, 1}, {Picture{1, 1, {vec3(1)}}, {}}});
  EXPECT_TRUE(sum.reference().variance.empty()) << "of a single pass it is not known";
}

TEST_F(ReferenceTest, OfTheFurnaceIsItsClosedFormWithItsUncertainty) {
  const ReferenceJob wanted = job("furnace", 32, 18, 48);
  const auto summary = make("furnace_objects", {}, wanted);
  ASSERT_TRUE(summary.ok()) << summary.error().message;
  EXPECT_NEAR(summary->error.mean_luminance, 1.75, 1e-3);  // emission 1, albedo 1/2, two bounces
  EXPECT_EQ(summary->samples, 48u);
  const auto image = read_exr(wanted.out);
  ASSERT_TRUE(image.ok());
  for (const char* name : {"R", "G", "B", "variance.R", "albedo.G", "normal.X", "Z"})
    EXPECT_NE(image->channel(name), nullptr) << name;
  for (const float v : *image->channel("variance.R")) EXPECT_GE(v, 0.0f);
  EXPECT_EQ(image->texts().at("fullbright.jitter"), "1") << "r_jitter -1: references cover the pixel";
  EXPECT_EQ(image->texts().at("fullbright.spp"), "48");
  EXPECT_EQ(image->texts().at("fullbright.estimator"), "pt");
}

TEST_F(ReferenceSequences, InterruptedSplitOrGrownItIsTheSame) {
  // An estimator that learns, so that what one block has learnt would show in the next.
  const render::RenderSettings settings = repeatable("mcpg_nee");
  const ReferenceJob whole = job("whole", 12, 12, kSpp);
  ASSERT_TRUE(make("one_light", settings, whole).ok());

  // Interrupted: a block is missing, another one was cut off while it was written.
  ReferenceJob again = whole;
  again.out = path("again.exr");
  ASSERT_NE(remove_block(whole.blocks, "block_0000_256.exr"), "");
  const std::string damaged = remove_block(whole.blocks, "block_0002_388.exr");
  std::ofstream(damaged) << "no picture";
  auto summary = make("one_light", settings, again);
  ASSERT_TRUE(summary.ok()) << summary.error().message;
  EXPECT_EQ(summary->made, 256u + 388u) << "the block that was whole is not made again";
  expect_same(whole.out, again.out);

  // Grown from fewer samples; and there already.
  ReferenceJob grown = job("grown", 12, 12, 300);
  ASSERT_TRUE(make("one_light", settings, grown).ok());
  grown.spp = kSpp;
  EXPECT_TRUE(make("one_light", settings, grown).ok());
  expect_same(whole.out, grown.out);
  EXPECT_EQ(make("one_light", settings, grown)->made, 0u);

  // Split.
  std::vector<std::string> folders;
  for (std::uint32_t shard = 1; shard <= 2; ++shard) {
    ReferenceJob part = job(fmt::format("part{}", shard), 12, 12, kSpp);
    part.view = whole.view;
    part.shard = shard;
    part.shards = 2;
    ASSERT_TRUE(make("one_light", settings, part).ok());
    EXPECT_FALSE(std::filesystem::exists(part.out));
    folders.push_back(part.blocks);
  }
  const auto merged = merge_references(folders, path("merged.exr"));
  ASSERT_TRUE(merged.ok()) << merged.error().message;
  EXPECT_EQ(merged->samples, kSpp);
  expect_same(whole.out, path("merged.exr"));

  // What cannot be joined is named.
  EXPECT_NE(merge_references({folders[0], folders[0]}, path("no.exr")).error().message.find("block 0 is there twice"),
            std::string::npos);
  EXPECT_NE(
      merge_references({folders[0]}, path("no.exr")).error().message.find("block 1 (samples 256 to 512) is missing"),
      std::string::npos);
  render::RenderSettings other = settings;
  other.bounces = 1;
  ReferenceJob unlike = job("unlike", 12, 12, kSpp);
  unlike.shard = unlike.shards = 2;
  ASSERT_TRUE(make("one_light", other, unlike).ok());
  EXPECT_NE(merge_references({folders[0], unlike.blocks}, path("no.exr")).error().message.find("blocks are of"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("no.exr")));
}

TEST_F(ReferenceSequences, EndsAtTheErrorThatIsAskedFor) {
  render::RenderSettings sharp;
  sharp.jitter = 0;
  ReferenceJob wanted = job("lava", 24, 24, 1u << 16u);
  wanted.relative_error = 0.025;
  const auto summary = make("lava", sharp, wanted);
  ASSERT_TRUE(summary.ok());
  EXPECT_LE(summary->error.relative, 0.025);
  EXPECT_GT(summary->samples, 256u);
  EXPECT_LT(summary->samples, 1u << 16u);
  ReferenceJob less = wanted;
  less.relative_error = 0;
  less.spp = summary->samples - 256;  // the last block was needed
  less.out = path("less.exr");
  EXPECT_GT(make("lava", sharp, less)->error.relative, 0.025);
  ReferenceJob brief = job("brief", 24, 24, 1u << 24u);
  brief.seconds = 0.01;
  EXPECT_EQ(make("lava", sharp, brief)->samples, 256u) << "a block at least";
}

TEST_F(ReferenceSequences, WarmingUpTeachesWhoLearnsAndChangesNothingElse) {
  struct Run {
    ReferenceSummary summary;
    double variance;  // the mean pixel's
  };
  const auto run = [&](const char* estimator, std::uint32_t warmup) {
    render::RenderSettings settings = repeatable(estimator);
    settings.jitter = 0;  // edges are as noisy for one who has learnt all
    ReferenceJob wanted = job("warm", 48, 48, 16);
    wanted.warmup = warmup;
    const auto summary = make("one_light", settings, wanted);
    const std::vector<float> variances = plane(wanted.out, "variance.G");
    return Run{*summary, std::accumulate(variances.begin(), variances.end(), 0.0) / double(variances.size())};
  };
  EXPECT_EQ(run("pt", 100).summary.error.mean_luminance, run("pt", 0).summary.error.mean_luminance)
      << "the same random numbers";
  const Run cold = run("mcpg", 0), warm = run("mcpg", 512);
  EXPECT_EQ(warm.summary.samples, 16u) << "what it has learnt from is not in the mean";
  EXPECT_LT(warm.variance, 0.2 * cold.variance);
  EXPECT_NEAR(warm.summary.error.mean_luminance, cold.summary.error.mean_luminance,
              0.05 * cold.summary.error.mean_luminance);
}

TEST(ReferenceSubject, SeedsBeyondTheWholeNumbersOfFloatsAreTwoKeys) {
  ReferenceSubject first, second;
  first.settings.seed = 16777216;
  second.settings.seed = 16777217;
  EXPECT_EQ(float(first.settings.seed), float(second.settings.seed)) << "the case that is meant";
  EXPECT_NE(first.key(), second.key());
  EXPECT_EQ(first.key(), ReferenceSubject(first).key());
}

TEST(Replicates, TakeEverySampleOnceInEqualParts) {
  for (const std::uint32_t samples : {0u, 1u, 7u, 8u, 9u, 256u, 388u}) {
    const auto plan = plan_replicates(samples);
    EXPECT_EQ(std::accumulate(plan.begin(), plan.end(), 0u), samples);
    EXPECT_EQ(plan.size(), std::min(samples, 8u));
    if (!plan.empty()) {
      EXPECT_LE(plan.front() - plan.back(), 1u);
    }
  }
}

TEST(Replicates, VarianceIsBetweenTheirMeans) {
  const auto picture = [](float value) { return Picture{1, 1, {vec3(value)}}; };
  ReplicateSum sum;
  EXPECT_TRUE(sum.reference().mean.pixels.empty());
  sum.add(picture(1), 2);
  EXPECT_TRUE(sum.reference().variance.empty()) << "one knows none";
  sum.add(picture(4), 1);
  EXPECT_FLOAT_EQ(sum.reference().mean.pixels[0].x, 2);
  // By hand: a sample's variance v gives v / 2 + v between the two means, 9 here; so v is 6, and a third of it is that
  // of the mean of three.
  EXPECT_FLOAT_EQ(sum.reference().variance[0].x, 2);
  ReplicateSum equal;
  for (int i = 0; i < 8; ++i) equal.add(picture(0.1f), 32);
  EXPECT_EQ(equal.reference().variance[0].x, 0.0f) << "exactly: what glows has no error";
}

TEST_F(ReferenceTest, WhatCannotBeIsASentence) {
  ReferenceJob nowhere = job("nowhere", 8, 8, 1);
  nowhere.blocks.clear();
  nowhere.out = path("no/such/folder/x.exr");
  EXPECT_FALSE(make("cbox", {}, nowhere).ok());
  EXPECT_NE(merge_references({path("nothing")}, path("x.exr")).error().message.find("nothing"), std::string::npos);
  std::filesystem::create_directory(path("empty"));
  EXPECT_NE(merge_references({path("empty")}, path("x.exr")).error().message.find("it has none"), std::string::npos);
}

}  // namespace
}  // namespace fb::lab
