// The tone curve: what it keeps, and where it ends.
#include "shared/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace fb::shared {
namespace {

float luminance(vec3 c) { return dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

vec3 each_channel(vec3 c) { return {filmic_curve(c.x), filmic_curve(c.y), filmic_curve(c.z)}; }

TEST(Tone, GreyFollowsTheCurve) {
  for (float x = 0; x < 1e4f; x = 1.1f * x + 1e-4f) {
    const vec3 shown = filmic(vec3(x));
    EXPECT_NEAR(shown.x, filmic_curve(x), 1e-6f) << x;
    EXPECT_EQ(shown.x, shown.y);
    EXPECT_EQ(shown.x, shown.z);
  }
  EXPECT_EQ(filmic(vec3(0)), vec3(0)) << "exactly";
  EXPECT_EQ(filmic_curve(1e4f), 1.0f);
}

// The curve itself rises again there.
TEST(Tone, BelowZeroIsBlack) {
  for (const float x : {-1e-4f, -0.05f, -1.0f, -1e4f}) {
    EXPECT_EQ(filmic(vec3(x)), vec3(0)) << x;
    EXPECT_EQ(filmic(vec3(x, 0.5f, 0.2f)), filmic(vec3(0, 0.5f, 0.2f))) << x;
    EXPECT_EQ(srgb_from_linear(vec3(x)), vec3(0)) << x;
  }
}

TEST(Tone, ColoursAreTruerThanEachChannelsCurve) {
  const vec3 brown(1.0f, 0.6f, 0.3f);
  for (const float scale : {0.003f, 0.03f, 0.3f, 1.0f, 3.0f}) {
    const vec3 shown = filmic(brown * scale), film = each_channel(brown * scale);
    for (int i = 1; i < 3; ++i)
      EXPECT_LT(std::abs(shown[i] / shown.x - brown[i]), 0.65f * std::abs(film[i] / film.x - brown[i])) << scale;
  }
}

TEST(Tone, ARedLampIsRedAndTheSunIsWhite) {
  const vec3 red(1.0f, 0.03f, 0.03f);
  const vec3 lamp = srgb_from_linear(filmic(8.0f * red)), sun = srgb_from_linear(filmic(1e4f * red));
  EXPECT_GT(lamp.x, 0.95f);
  EXPECT_LT(lamp.y, 0.57f) << "each channel by itself: " << srgb_from_linear(each_channel(8.0f * red)).y;
  EXPECT_GT(sun.y, 0.95f);
}

TEST(Tone, BrighterIsNeverShownDarker) {
  for (const vec3 color : {vec3(1, 0.5f, 0.1f), vec3(0, 0, 1), vec3(0.2f, 1, 0.2f)}) {
    vec3 before(0);
    for (float x = 1e-4f; x < 1e4f; x *= 1.05f) {
      const vec3 shown = filmic(color * x);
      for (int i = 0; i < 3; ++i) EXPECT_GE(shown[i], before[i] * (1 - 1e-5f)) << x << ' ' << i;
      EXPECT_GT(luminance(shown), 0.0f);
      before = shown;
    }
  }
}

}  // namespace
}  // namespace fb::shared
