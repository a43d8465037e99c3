// What makes two frames two.
#include "render/passes/frame_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>

namespace fb::render {
namespace {

// Two values that are neighbours in their own type; integers beyond 2^24, where floats are no longer whole numbers'.
template <typename T>
T first_of_two() {
  return std::is_integral_v<T> ? T(1 << 24) : T(1);
}
template <typename T>
T second_of_two() {
  if constexpr (std::is_integral_v<T>)
    return first_of_two<T>() + 1;
  else
    return std::nextafter(first_of_two<T>(), std::numeric_limits<T>::max());
}

TEST(SettingsKey, EverySettingCountsInItsOwnType) {
#define FB_CHECK_ROW(type, field, cvar, value, low, high, help)   \
  {                                                               \
    RenderSettings first, second;                                 \
    first.field = first_of_two<type>();                           \
    second.field = second_of_two<type>();                         \
    EXPECT_NE(settings_key(first), settings_key(second)) << cvar; \
    EXPECT_NE(view_key(5, first), view_key(5, second)) << cvar;   \
  }
  FB_RENDER_SETTINGS(FB_CHECK_ROW)
#undef FB_CHECK_ROW
  RenderSettings nee;
  nee.estimator = "nee";
  EXPECT_NE(settings_key(nee), settings_key({}));
  EXPECT_EQ(settings_key({}), settings_key({}));
}

TEST(SceneKey, KnowsTheTimeOfAFrameAfterDays) {
  scene::FrameSnapshot first;
  first.assets = std::make_shared<scene::Assets>();
  first.time = 1e6;  // seconds: floats are a sixteenth apart
  scene::FrameSnapshot second = first;
  second.time += 1.0 / 72;
  EXPECT_NE(scene_key(first), scene_key(second));
}

// A still view under another sky is another.
TEST(SceneKey, KnowsTheSkyAndItsSuns) {
  scene::FrameSnapshot first;
  first.assets = std::make_shared<scene::Assets>();
  first.sky.suns.emplace_back();
  EXPECT_EQ(scene_key(first), scene_key(scene::FrameSnapshot(first)));
  scene::FrameSnapshot turned = first, lit = first, colored = first, more = first;
  turned.sky.suns[0].direction = vec3(1, 0, 0);
  lit.sky.suns[0].irradiance = vec3(1);
  colored.sky.color = vec3(1);
  more.sky.suns.emplace_back();
  for (const scene::FrameSnapshot& other : {turned, lit, colored, more}) EXPECT_NE(scene_key(first), scene_key(other));
}

}  // namespace
}  // namespace fb::render
