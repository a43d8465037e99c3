// compare on files made here: what it computes, what it writes, what it refuses.
#include "lab/compare/compare_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rng.h"
#include "base/test_directory.h"
#include "lab/image_io.h"
#include "shared/tone.h"

namespace fb::lab {
namespace {

using ::testing::HasSubstr;

class CompareTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  // Noise of variance deviation^2 / 3 about `value`; `variance` (if not negative) is written as its variance.
  std::string exr(const std::string& name, float value, float deviation, std::uint64_t seed, float variance = -1,
                  std::uint32_t width = 48, std::uint32_t height = 32) const {
    ExrImage image(width, height);
    Rng rng(seed);
    for (const char* channel : {"R", "G", "B"}) {
      std::vector<float> plane(image.pixels());
      for (float& v : plane) v = value + rng.uniform(-deviation, deviation);
      image.add_channel(channel, plane);
      if (variance >= 0)
        image.add_channel(std::string("variance.") + channel, std::vector<float>(image.pixels(), variance));
    }
    EXPECT_TRUE(write_exr(path(name), image).ok());
    return path(name);
  }
  std::string png(const std::string& name, std::uint32_t grey) const {
    const std::vector<std::uint32_t> pixels(48 * 32, grey * 0x010101u);
    EXPECT_TRUE(write_png(path(name), 48, 32, pixels).ok());
    return path(name);
  }
  static double figure(const Comparison& c, std::size_t file, const std::string& name) {
    for (const Figure& f : c.files[file].figures)
      if (f.name == name) return f.value;
    ADD_FAILURE() << "no figure " << name;
    return 0;
  }
  const TestDirectory directory_;
};

TEST_F(CompareTest, FlickerIsOfWhatDoesNotMoveWithThePicture) {
  constexpr std::uint32_t kWidth = 24, kHeight = 16;
  // Everything moves by a pixel to the right; so does the error, unless `flickers`.
  const auto frame = [&](const std::string& name, int number, float error) {
    ExrImage image(kWidth, kHeight);
    std::vector<float> plane(image.pixels());
    for (std::size_t i = 0; i < plane.size(); ++i)
      plane[i] = 0.3f + ((static_cast<int>(i % kWidth) - number) % 2 == 0 ? error : 0.0f);
    for (const char* channel : {"R", "G", "B"}) image.add_channel(channel, plane);
    image.add_channel("motion.X", std::vector<float>(image.pixels(), -1.0f));
    image.add_channel("motion.Y", std::vector<float>(image.pixels(), 0.0f));
    for (const char* channel : {"Z", "previous.Z"})
      image.add_channel(channel, std::vector<float>(image.pixels(), 5.0f));
    EXPECT_TRUE(write_exr(path(name), image).ok());
    return path(name);
  };
  CompareJob job;
  job.flip = false;
  job.former_reference = frame("r0.exr", 0, 0);
  job.former_test = frame("t0.exr", 0, 0.1f);
  job.reference = frame("r1.exr", 1, 0);
  job.tests = {frame("carried.exr", 1, 0.1f)};
  EXPECT_NEAR(figure(*compare(job), 0, "flicker"), 0, 1e-6);
  job.tests = {frame("flickers.exr", 0, 0.1f)};
  const float step = shared::srgb_from_linear(vec3(0.4f)).x - shared::srgb_from_linear(vec3(0.3f)).x;
  EXPECT_NEAR(figure(*compare(job), 0, "flicker"), step, 1e-5) << "every pixel changes by the error";
  job.reference = exr("still.exr", 0.3f, 0, 1, -1, kWidth, kHeight);
  EXPECT_THAT(compare(job).error().message, HasSubstr("still.exr: flicker wants motion.X"));
  job.tests.push_back(job.tests.front());
  EXPECT_THAT(compare(job).error().message, HasSubstr("--former is of one picture"));
}

TEST_F(CompareTest, RunsOfOneThing) {
  CompareJob job;
  job.reference = exr("reference.exr", 1.0f, 0.3f, 1, 0.03f);
  for (int i = 0; i < 8; ++i)
    job.tests.push_back(exr("run" + std::to_string(i) + ".exr", 1.2f, 0.6f, 10 + static_cast<std::uint64_t>(i)));
  const auto c = compare(job);
  ASSERT_TRUE(c.ok()) << c.error().message;
  EXPECT_TRUE(c->linear);
  EXPECT_NEAR(*c->reference_variance, 0.03, 1e-6);
  EXPECT_NEAR(figure(*c, 0, "mse"), 0.12 + 0.04 + 0.03, 0.01);
  EXPECT_NEAR(figure(*c, 0, "mse_corrected"), 0.16, 0.01);
  EXPECT_NEAR(figure(*c, 0, "bias"), 0.2, 0.03);
  EXPECT_GT(figure(*c, 0, "flip_hdr"), 0);
  ASSERT_EQ(c->spreads.size(), c->files[0].figures.size());
  const Spread& mse = c->spreads[0];
  EXPECT_EQ(mse.name, "mse");
  EXPECT_LT(mse.typical.interval.low, mse.mean);
  EXPECT_GT(mse.typical.interval.high, mse.mean);
  EXPECT_NEAR(*c->variance, 0.12, 0.004);
  EXPECT_NEAR(*c->bias_squared, 0.04, 0.006);
  EXPECT_THAT(comparison_table(*c), HasSubstr("bias_squared"));
  EXPECT_THAT(comparison_table(*c), HasSubstr("  ms_ssim            -\n")) << "too small a picture";
  EXPECT_THAT(comparison_table(*c), testing::Not(HasSubstr("nan")));
  EXPECT_THAT(comparison_json(*c), HasSubstr("\"interval95\""));
  const std::string csv = comparison_csv(*c);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 9);
  EXPECT_THAT(csv, HasSubstr("file,mse,mse_corrected,rmse,relmse,relmse_corrected,mape,smape,psnr,bias,"
                             "mse_median_pixel,top_share,ssim,ms_ssim,low_frequencies,flip_ldr,flip_hdr,not_finite\n"));
  job.tests.back() = job.tests.front();
  EXPECT_THAT(compare(job).error().message, HasSubstr("the same picture as"));
  job.tests.pop_back();
  EXPECT_THAT(comparison_table(*compare(job)), HasSubstr("7 files: mean; 95% intervals want 8 runs; there are 7"));
}

// Most of the bias's error is the reference's here, and common to all runs.
TEST_F(CompareTest, TheBiasOfRunsHasTheReferencesErrorToo) {
  constexpr int kTrials = 200;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto seed = 100 * static_cast<std::uint64_t>(trial);
    CompareJob job;
    job.flip = false;
    job.reference = exr("reference.exr", 1.0f, 0.6f, seed, 0.12f, 8, 8);
    for (std::uint64_t i = 1; i <= 8; ++i)
      job.tests.push_back(exr("run" + std::to_string(i) + ".exr", 1.0f, 0.85f, seed + i, -1, 8, 8));
    const auto c = compare(job);
    ASSERT_TRUE(c.ok()) << c.error().message;
    const auto bias = std::ranges::find(c->spreads, "bias", &Spread::name);
    ASSERT_NE(bias, c->spreads.end());
    held += bias->typical.interval.low <= 0 && bias->typical.interval.high >= 0;
  }
  EXPECT_GE(held, 178) << "0.95 less four binomial standard errors";
  EXPECT_LE(held, 199);
}

TEST_F(CompareTest, RareSamplesAreToldOf) {
  CompareJob job;
  job.flip = false;
  job.reference = exr("reference.exr", 1.0f, 0.0f, 1);
  for (std::uint64_t i = 1; i <= 8; ++i) job.tests.push_back(exr("even" + std::to_string(i) + ".exr", 1.0f, 0.5f, i));
  const auto even = compare(job);
  ASSERT_TRUE(even.ok()) << even.error().message;
  EXPECT_LT(*even->tail, 0.1) << "squares of uniform numbers end";
  EXPECT_THAT(comparison_table(*even), testing::Not(HasSubstr("rare samples")));
  EXPECT_THAT(comparison_json(*even), HasSubstr("\"tail_shape\""));
  job.tests.clear();
  Rng rng(5);
  for (int i = 0; i < 8; ++i) {
    ExrImage image(48, 32);
    for (const char* channel : {"R", "G", "B"}) {
      std::vector<float> plane(image.pixels());
      for (float& v : plane) v = 1.0f + std::pow(1.0f - rng.uniform(0.0f, 1.0f), -0.4f);  // its squares' shape is 0.8
      image.add_channel(channel, plane);
    }
    job.tests.push_back(path("wild" + std::to_string(i) + ".exr"));
    ASSERT_TRUE(write_exr(job.tests.back(), image).ok());
  }
  const auto wild = compare(job);
  ASSERT_TRUE(wild.ok()) << wild.error().message;
  EXPECT_NEAR(*wild->tail, 0.8, 0.3);
  EXPECT_THAT(comparison_table(*wild), HasSubstr("what these 8 files lack"));
}

TEST_F(CompareTest, PngsAreComparedAsStored) {
  CompareJob job;
  job.reference = png("a.png", 0);
  job.tests = {png("b.png", 255)};
  job.flip_map = path("map.png");
  const auto c = compare(job);
  ASSERT_TRUE(c.ok()) << c.error().message;
  EXPECT_FALSE(c->linear);
  EXPECT_DOUBLE_EQ(figure(*c, 0, "mse"), 1);
  EXPECT_DOUBLE_EQ(figure(*c, 0, "psnr"), 0);
  EXPECT_NEAR(figure(*c, 0, "flip"), 0.967, 1e-3);
  EXPECT_TRUE(std::filesystem::exists(job.flip_map));
  job.tests = {job.reference};
  EXPECT_EQ(figure(*compare(job), 0, "flip"), 0);
  EXPECT_THAT(comparison_json(*compare(job)), HasSubstr("\"psnr\": null"));
}

TEST_F(CompareTest, RefusesInOneSentenceThatNamesTheFile) {
  CompareJob job;
  job.reference = exr("reference.exr", 1, 0, 1);
  const auto refusal = [&](const std::string& test) {
    job.tests = {test};
    const auto c = compare(job);
    return c ? std::string("taken") : c.error().message;
  };
  EXPECT_THAT(refusal(path("absent.exr")), HasSubstr("absent.exr"));
  EXPECT_THAT(refusal(path("x.jpg")), HasSubstr("x.jpg: an .exr or a .png"));
  EXPECT_THAT(refusal(png("p.png", 3)), HasSubstr("p.png"));
  EXPECT_THAT(refusal(exr("small.exr", 1, 0, 1, -1, 8, 8)), HasSubstr("8x8 pixels, but"));
  ExrImage depth(48, 32);
  depth.add_channel("Z", std::vector<float>(depth.pixels()));
  ASSERT_TRUE(write_exr(path("depth.exr"), depth).ok());
  EXPECT_THAT(refusal(path("depth.exr")), HasSubstr("no channel R"));
  job.reference = exr("inf.exr", std::numeric_limits<float>::infinity(), 0, 1);
  EXPECT_THAT(refusal(job.reference), HasSubstr("not finite"));
  for (const float variance : {-1e-3f, std::numeric_limits<float>::quiet_NaN()}) {
    ExrImage image(48, 32);
    for (const char* channel : {"R", "G", "B", "variance.R", "variance.G", "variance.B"})
      image.add_channel(channel, std::vector<float>(image.pixels(), channel[0] == 'v' ? variance : 1.0f));
    ASSERT_TRUE(write_exr(path("variance.exr"), image).ok());
    job.reference = path("variance.exr");
    EXPECT_THAT(refusal(job.reference), HasSubstr("below zero or not finite"));
  }
  job.flip_map = "map.png";
  job.tests = {"a.exr", "b.exr"};
  EXPECT_THAT(compare(job).error().message, HasSubstr("--flip-map"));
}

}  // namespace
}  // namespace fb::lab
