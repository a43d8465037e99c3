// render/techniques/outlier_removal.h: what is kept, and what an outlier loses.
#include "render/techniques/outlier_removal.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <vector>

#include "base/rng.h"

namespace fb::render {
namespace {

constexpr uvec2 kPictureSize{8, 6};
constexpr std::size_t kPicturePixels = 48;

double sum_of(const std::vector<vec4>& picture) {
  return std::accumulate(picture.begin(), picture.end(), 0.0,
                         [](double sum, const vec4& p) { return sum + static_cast<double>(p.y); });
}
// Even light with noise, in every frame.
SingleSamples noise(std::uint32_t frames) {
  SingleSamples samples;
  Rng rng(2);
  for (std::uint32_t k = 0; k < frames; ++k) {
    std::vector<vec4> frame;
    for (std::size_t i = 0; i < kPicturePixels; ++i) frame.emplace_back(vec4(rng.uniform(0.0f, 2.0f)));
    samples.add(frame);
  }
  return samples;
}

TEST(OutlierRemoval, WhatIsCommonAboutAPixelIsLeftAsItIs) {
  const SingleSamples samples = noise(8);
  const auto all = samples.without_outliers(kPictureSize, 1e-9), some = samples.without_outliers(kPictureSize, 4);
  EXPECT_NEAR(sum_of(all), kPicturePixels, 0.2 * kPicturePixels);
  for (std::size_t i = 0; i < kPicturePixels; ++i) EXPECT_NEAR(some[i].x, all[i].x, 0.05f * all[i].x) << i;
}

TEST(OutlierRemoval, ASampleAloneCountsByWhatIsMissing) {
  constexpr std::size_t kAt = 3 * 8 + 4;
  SingleSamples samples = noise(8);
  const double before = sum_of(samples.without_outliers(kPictureSize, 4));
  samples.shift(5, kAt, glm::dvec3(1e5));
  const auto in_full = samples.without_outliers(kPictureSize, 1e-9), less = samples.without_outliers(kPictureSize, 4),
             half = samples.without_outliers(kPictureSize, 2);
  EXPECT_NEAR(in_full[kAt].x, 1e5 / 8, 2);
  // Of one sample that two layers share each knows of the whole.
  EXPECT_GT(less[kAt].x, 0.1 * 1e5 / 8);
  EXPECT_LT(less[kAt].x, 0.8 * 1e5 / 8);
  EXPECT_NEAR(half[kAt].x, 2 * less[kAt].x, 0.3 * less[kAt].x);
  EXPECT_NEAR(sum_of(less) - static_cast<double>(less[kAt].x), before, 2) << "no other pixel is another";
  // Where neighbours have as bright ones, all count.
  for (const std::size_t neighbour : {kAt - 9, kAt - 1, kAt + 1, kAt + 8, kAt + 9})
    for (std::uint32_t frame = 0; frame < 4; ++frame) samples.shift(frame, neighbour, glm::dvec3(1e5));
  EXPECT_NEAR(samples.without_outliers(kPictureSize, 4)[kAt].x, 1e5 / 8, 2);
}

TEST(OutlierRemoval, NoLightAndOnePixelAreFine) {
  SingleSamples dark;
  dark.add(std::vector<vec4>(kPicturePixels, vec4(0.0f)));
  EXPECT_EQ(sum_of(dark.without_outliers(kPictureSize, 4)), 0);
  SingleSamples one;
  one.add(std::vector<vec4>{vec4(1e30f)});
  const float shown = one.without_outliers({1, 1}, 4)[0].x;
  EXPECT_GT(shown, 0);
  EXPECT_LE(shown, 1e30f);
}

TEST(OutlierRemoval, SavedAndLoadedTheyAreTheSame) {
  const SingleSamples samples = noise(3);
  Bytes state;
  samples.save(state);
  SingleSamples read;
  ByteReader reader(state, "state");
  ASSERT_TRUE(read.load(reader, kPicturePixels));
  EXPECT_EQ(read.count(), 3u);
  EXPECT_EQ(read.without_outliers(kPictureSize, 4), samples.without_outliers(kPictureSize, 4));
  ByteReader other(state, "state"), cut(ByteView(state.data(), state.size() - 1), "state");
  EXPECT_FALSE(read.load(other, kPicturePixels + 1));
  EXPECT_FALSE(read.load(cut, kPicturePixels));
  EXPECT_EQ(read.count(), 0u);
}

}  // namespace
}  // namespace fb::render
