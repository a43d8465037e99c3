#include "scene/library/lightmaps.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "scene/library/test_lit_room.h"

namespace fb::scene {
namespace {

using test::bake;
using test::kLitFloor;
using test::kLitReflectance;
using test::kLitRoom;
using test::lit_room;

formats::Bsp baked_room() {
  formats::Bsp bsp = lit_room().bsp;
  bake(bsp, [](const vec3& p, const vec3&) { return p.x / kLitRoom; });
  return bsp;
}

Bytes lit_file(std::size_t samples, std::array<std::uint8_t, 3> color) {
  Bytes file{'Q', 'L', 'I', 'T', 1, 0, 0, 0};
  for (std::size_t i = 0; i < samples; ++i) file.insert(file.end(), color.begin(), color.end());
  return file;
}

TEST(Lightmaps, BakedLightComesBackBetweenLuxels) {
  const formats::Bsp bsp = baked_room();
  const Lightmaps maps(bsp);
  ASSERT_TRUE(maps.has(kLitFloor, 0));
  EXPECT_FALSE(maps.has(kLitFloor, 1)) << "one style";
  EXPECT_FALSE(maps.colored());
  for (const float x : {32.0f, 200.0f, 328.0f}) {
    const vec3 light = light_of_display(maps.value(kLitFloor, 0, vec3(x, 100, 0)), vec3(kLitReflectance));
    EXPECT_NEAR(light.x, x / kLitRoom, 0.02f) << x;
  }
}

TEST(Lightmaps, AMapWithoutLightHasNone) {
  const formats::Bsp bsp = lit_room().bsp;
  EXPECT_TRUE(Lightmaps(bsp).empty());
  EXPECT_FALSE(Lightmaps(bsp).has(kLitFloor, 0));
  EXPECT_EQ(Lightmaps(bsp).value(kLitFloor, 0, vec3(0)), vec3(0));
}

// A light file of one colour, and one of a single luxel that is not black.
TEST(Lightmaps, HowMuchOfItIsBlackIsKnown) {
  const formats::Bsp bsp = baked_room();
  EXPECT_LT(Lightmaps(bsp).black_share(), 0.5);
  EXPECT_EQ(Lightmaps(bsp, lit_file(bsp.lighting.size(), {0, 1, 0})).black_share(), 0.0);
  Bytes file = lit_file(bsp.lighting.size(), {0, 0, 0});
  EXPECT_EQ(Lightmaps(bsp, file).black_share(), 1.0);
  file.back() = 1;
  EXPECT_NEAR(Lightmaps(bsp, file).black_share(), 1.0 - 1.0 / static_cast<double>(bsp.lighting.size()), 1e-9);
  EXPECT_EQ(Lightmaps(lit_room().bsp).black_share(), 1.0) << "none at all";
}

TEST(Lightmaps, AFileOfColouredLightIsUsedWhereItFits) {
  const formats::Bsp bsp = baked_room();
  const Bytes fits = lit_file(bsp.lighting.size(), {128, 64, 0}), small = lit_file(bsp.lighting.size() - 1, {9, 9, 9});
  const Lightmaps colored(bsp, fits);
  EXPECT_TRUE(colored.colored());
  EXPECT_EQ(colored.value(kLitFloor, 0, vec3(100, 100, 0)), vec3(1.0f, 0.5f, 0.0f));
  EXPECT_EQ(colored.lit_error(), "");
  const Bytes large = lit_file(bsp.lighting.size() + 1, {9, 9, 9});
  Bytes odd = fits;
  odd.push_back(0);
  const Bytes other{'Q', 'L', 'I', 'T', 2, 0, 0, 0};
  const std::string takes = fmt::format("samples take {}", 3 * bsp.lighting.size());
  for (const auto& [file, why] : {std::pair<Bytes, std::string>{small, takes},
                                  {large, takes},
                                  {odd, takes},
                                  {other, "version 1"},
                                  {Bytes{}, "it is empty"}}) {
    const Lightmaps refused(bsp, file);
    EXPECT_FALSE(refused.colored());
    EXPECT_NE(refused.lit_error().find(why), std::string::npos) << refused.lit_error();
    EXPECT_NEAR(refused.value(kLitFloor, 0, vec3(200, 100, 0)).x,
                Lightmaps(bsp).value(kLitFloor, 0, vec3(200, 100, 0)).x, 1e-6f)
        << "the map's own";
  }
  EXPECT_EQ(Lightmaps(bsp).lit_error(), "") << "no file is no error";
}

TEST(Lightmaps, LuxelsLieWhereALumpSays) {
  formats::Bsp bsp = baked_room();
  Bytes lump(bsp.faces.size() * 40, 0);
  const auto put = [&](std::size_t at, const auto& value) { std::memcpy(&lump[at], &value, sizeof value); };
  for (std::size_t f = 0; f < bsp.faces.size(); ++f) {
    put(40 * f, std::uint16_t{2});
    put(40 * f + 2, std::uint16_t{1});
    put(40 * f + 4, std::int32_t{0});
    put(40 * f + 8, 1.0f / kLitRoom);  // s = x / side
  }
  bsp.lighting = {0, 128};
  bsp.bspx.emplace_back("DECOUPLED_LM", lump);
  const Lightmaps maps(bsp);
  EXPECT_NEAR(maps.value(kLitFloor, 0, vec3(0.25f * kLitRoom, 0, 0)).x, 0.25f, 1e-5f);
  put(4, std::int32_t{1});  // the first face's would end beyond the lump
  bsp.bspx.back().second = lump;
  EXPECT_FALSE(Lightmaps(bsp).has(0, 0));
  EXPECT_TRUE(Lightmaps(bsp).has(1, 0));
  // Axes whose products are no numbers, and the largest that are taken.
  for (const float axis : {3e38f, -3e38f, 9e5f}) {
    for (std::size_t c = 0; c < 8; ++c) put(40 + 8 + 4 * c, c % 2 != 0 ? axis : -axis);
    bsp.bspx.back().second = lump;
    const Lightmaps wild(bsp);
    EXPECT_EQ(wild.has(1, 0), axis == 9e5f);
    for (const vec3& p : {vec3(0), vec3(kLitRoom), vec3(-3e4f, 3e4f, 1)})
      EXPECT_TRUE(std::isfinite(wild.value(1, 0, p).x)) << axis;
  }
}

// Of the right length, and nonsense: no luxels, more than there may be, axes that are no numbers.
TEST(Lightmaps, ALumpThatPlacesNothingIsNamed) {
  for (const int nonsense : {0, 1, 2}) {
    formats::Bsp bsp = baked_room();
    Bytes lump(bsp.faces.size() * 40, 0);
    for (std::size_t f = 0; f < bsp.faces.size(); ++f) {
      const std::uint16_t side = nonsense == 0 ? 0 : nonsense == 1 ? 65535 : 2;
      const float axis = nonsense == 2 ? std::nanf("") : 1.0f;
      std::memcpy(&lump[40 * f], &side, 2);
      std::memcpy(&lump[40 * f + 2], &side, 2);
      std::memcpy(&lump[40 * f + 8], &axis, 4);
    }
    bsp.bspx.emplace_back("DECOUPLED_LM", lump);
    const Lightmaps maps(bsp);
    ASSERT_EQ(maps.errors().size(), 1u) << nonsense;
    EXPECT_NE(maps.errors()[0].find("no place for light on any face"), std::string::npos) << maps.errors()[0];
    EXPECT_TRUE(maps.has(kLitFloor, 0)) << "the usual ones count instead";
  }
}

TEST(Lightmaps, LumpsThatDoNotFitAreNamed) {
  formats::Bsp bsp = baked_room();
  EXPECT_TRUE(Lightmaps(bsp).errors().empty());
  bsp.bspx.emplace_back("RGBLIGHTING", Bytes(3 * bsp.lighting.size(), 64));
  EXPECT_TRUE(Lightmaps(bsp).errors().empty());
  EXPECT_TRUE(Lightmaps(bsp).colored());
  bsp.bspx.back().second.pop_back();
  bsp.bspx.emplace_back("DECOUPLED_LM", Bytes(bsp.faces.size() * 40 - 1, 0));
  const Lightmaps maps(bsp);
  EXPECT_FALSE(maps.colored());
  ASSERT_EQ(maps.errors().size(), 2u);
  EXPECT_NE(maps.errors()[0].find("RGBLIGHTING"), std::string::npos) << maps.errors()[0];
  EXPECT_NE(maps.errors()[1].find("DECOUPLED_LM"), std::string::npos) << maps.errors()[1];
  EXPECT_TRUE(maps.has(kLitFloor, 0)) << "the usual ones count instead";

  formats::Bsp cut = baked_room();
  cut.lighting.pop_back();  // of the last face that was baked
  ASSERT_EQ(Lightmaps(cut).errors().size(), 1u);
  EXPECT_NE(Lightmaps(cut).errors()[0].find("1 of its"), std::string::npos) << Lightmaps(cut).errors()[0];
}

TEST(Lightmaps, DisplaysDecodeWhatQuakeMultiplies) {
  EXPECT_NEAR(light_of_display(vec3(1), vec3(0.2f)).x, 1.0f, 1e-4f) << "as painted";
  EXPECT_NEAR(light_of_display(vec3(0.5f), vec3(0.9f)).x, 0.21f, 0.02f) << "about a power of 2.2";
  EXPECT_NEAR(light_of_display(vec3(0.25f), vec3(0.004f)).x, 0.25f, 0.03f) << "the dark end of sRGB is linear";
  EXPECT_NEAR(light_of_display(vec3(2), vec3(0.5f)).x, 2.0f, 1e-4f) << "white is white";
}

}  // namespace
}  // namespace fb::scene
