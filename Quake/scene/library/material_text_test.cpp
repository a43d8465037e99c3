#include "scene/library/material_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fb::scene {
namespace {

TEST(MaterialText, SaysIndexAndAbsorption) {
  const auto glass = parse_material_text("// window\n  index 1.5\r\n\ncolor 0.5 1 .25 // teal\ndistance\t32", "a.mat");
  ASSERT_TRUE(glass.ok()) << glass.error().message;
  EXPECT_FLOAT_EQ(glass->index, 1.5f);
  EXPECT_NEAR(std::exp(-glass->absorption.x * 32), 0.5, 1e-6);
  EXPECT_EQ(glass->absorption.y, 0.0f);
  EXPECT_NEAR(std::exp(-glass->absorption.z * 64), 0.0625, 1e-6);
}

TEST(MaterialText, WithoutColourNothingIsAbsorbed) {
  const auto clear = parse_material_text("distance 2\nindex 1", "a.mat");
  ASSERT_TRUE(clear.ok());
  EXPECT_EQ(clear->absorption, vec3(0.0f));
  EXPECT_EQ(clear->scattering, 0.0f);
}

TEST(MaterialText, AByteOrderMarkIsNoProperty) {
  EXPECT_TRUE(parse_material_text("\xef\xbb\xbfindex 1.5", "a.mat").ok());
  EXPECT_FALSE(parse_material_text("\xef\xbb\xbf\xef\xbb\xbfindex 1.5", "a.mat").ok());
}

TEST(MaterialText, SaysWhereHalfIsScattered) {
  const auto milk = parse_material_text("index 1.34\nscatter 20", "a.mat");
  ASSERT_TRUE(milk.ok());
  EXPECT_NEAR(std::exp(-milk->scattering * 20), 0.5, 1e-6);
  EXPECT_EQ(milk->absorption, vec3(0.0f)) << "it is extinction as well, but no absorption";
}

TEST(MaterialText, SaysWhichLineIsWrong) {
  const auto message = [](std::string_view text) { return parse_material_text(text, "a.mat").error().message; };
  EXPECT_EQ(message(""), "a.mat: it names no index of refraction");
  EXPECT_EQ(message("color 1 1 1"), "a.mat: it names no index of refraction");
  EXPECT_EQ(message("index 1.5\nroughness 1"), "a.mat, line 2: roughness: index, color, distance or scatter is wanted");
  EXPECT_EQ(message("index"), "a.mat, line 1: index has 1 numbers, not 0");
  EXPECT_EQ(message("index 1.5\ncolor 1 1"), "a.mat, line 2: color has 3 numbers, not 2");
  for (const char* text :
       {"index 0.9", "index nan", "index five", "index 4.1", "index 1.5\ncolor 0 1 1", "index 1.5\ncolor 1 1 2",
        "index 1.5\ndistance 0", "index 1.5\ndistance inf", "index 1.5\nscatter 0"})
    EXPECT_NE(message(text).find("a.mat, line"), std::string::npos) << text;
}

}  // namespace
}  // namespace fb::scene
