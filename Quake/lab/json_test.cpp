#include "lab/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace fb::lab {
namespace {

TEST(Json, ObjectsArraysNumbersAndQuotes) {
  JsonWriter json;
  json.open_object();
  json.text("name", "a \"b\"\\\n").number("half", 0.5).integer("n", 7u).boolean("yes", true);
  json.open_array("list").number("", 1e-9).number("", std::numeric_limits<double>::quiet_NaN()).close();
  json.open_object("empty").close();
  json.close();
  EXPECT_EQ(json.str(),
            "{\n  \"name\": \"a \\\"b\\\"\\\\\\u000a\",\n  \"half\": 0.5,\n  \"n\": 7,\n  \"yes\": true,\n"
            "  \"list\": [\n    1e-09,\n    null\n  ],\n  \"empty\": {}\n}\n");
}

TEST(Json, AnotherReaderFindsWhatWasWritten) {
  JsonWriter writer;
  writer.open_object().text("name", "a \"quote\"\x01\xc3\xa9").number("x", 0.1).open_array("list").integer("", 7);
  const auto json = nlohmann::json::parse(writer.close().close().str(), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["name"], "a \"quote\"\x01\xc3\xa9");
  EXPECT_EQ(json["x"], 0.1);
  EXPECT_EQ(json["list"][0], 7);
}

}  // namespace
}  // namespace fb::lab
