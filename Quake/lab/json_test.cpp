#include "lab/json.h"

#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace fb::lab
