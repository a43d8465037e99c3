#include "lab/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "lab/compare/compare_job.h"

namespace fb::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

TEST(Json, MembersKeepTheirOrderAndWhatIsNoNumberIsNull) {
  Json json{{"name", "a \"b\"\\\n"}, {"half", 0.5}, {"a", 7u}, {"list", {1e-9, kNan, kInfinity}}};
  json["empty"] = Json::object();
  EXPECT_EQ(json_text(json),
            "{\n  \"name\": \"a \\\"b\\\"\\\\\\n\",\n  \"half\": 0.5,\n  \"a\": 7,\n"
            "  \"list\": [\n    1e-09,\n    null,\n    null\n  ],\n  \"empty\": {}\n}\n");
  EXPECT_EQ(json_text(json_of(Estimate{2, {1, kNan}}), -1), "{\"value\":2.0,\"interval95\":[1.0,null]}");
}

TEST(Json, NumbersAreReadAsTheyWere) {
  for (const double value : {0.1, 1.0 / 3, 1e-300, 1.7976931348623157e308, 5e-324, 16777217.0, -0.0}) {
    const double read = Json::parse(json_text(value, -1)).get<double>();
    EXPECT_EQ(read, value);
    EXPECT_EQ(std::signbit(read), std::signbit(value));
  }
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(Json::parse(json_text(kMost, -1)).get<std::uint64_t>(), kMost);
}

// A parser refuses bytes that are no UTF-8 (RFC 8259, 8.1), as a file's name in Latin-1 has them.
TEST(Json, NamesInOtherEncodingsGiveValidText) {
  Comparison comparison;
  comparison.job.reference = "caf\xe9.exr";
  comparison.files.emplace_back().file = "\xff.exr";
  const Json json = Json::parse(comparison_json(comparison), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["reference"], "caf\xef\xbf\xbd.exr");
  EXPECT_EQ(json["files"][0]["file"], "\xef\xbf\xbd.exr");
}

}  // namespace
}  // namespace fb::lab
