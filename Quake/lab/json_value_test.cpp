// JSON as the laboratory reads it: values, lines, and one sentence for what is wrong.
#include "lab/json_value.h"

#include <gtest/gtest.h>

#include <string>

#include "lab/json.h"

namespace fb::lab {
namespace {

TEST(JsonValue, ReadsEveryKind) {
  const auto json = parse_json(
      "{\"a\": [1, -2.5e3, true, false, null],\n \"b\": {\"c\": \"\\\"\\u00e9\\n\"}, \"d\": [], \"e\": {}}", "x.json");
  ASSERT_TRUE(json.ok()) << json.error().message;
  const JsonValue& a = *json->find("a");
  ASSERT_EQ(a.items.size(), 5u);
  EXPECT_EQ(a.items[0].number, 1);
  EXPECT_EQ(a.items[1].number, -2500);
  EXPECT_EQ(a.items[1].text, "-2.5e3") << "as it was written";
  EXPECT_TRUE(a.items[2].boolean);
  EXPECT_EQ(a.items[3].kind, JsonValue::Kind::kBoolean);
  EXPECT_EQ(a.items[4].kind, JsonValue::Kind::kNull);
  EXPECT_EQ(json->find("b")->line, 2);
  EXPECT_EQ(json->find("b")->find("c")->text, "\"\xc3\xa9\n");
  EXPECT_TRUE(json->find("d")->items.empty());
  EXPECT_TRUE(json->find("e")->members.empty());
  EXPECT_EQ(json->find("f"), nullptr);
}

TEST(JsonValue, ReadsWhatTheWriterWrites) {
  JsonWriter writer;
  writer.open_object().text("name", "a \"quote\"\x01").number("x", 0.1).open_array("list").integer("", 7);
  const auto json = parse_json(writer.close().close().str(), "written");
  ASSERT_TRUE(json.ok()) << json.error().message;
  EXPECT_EQ(json->find("name")->text, "a \"quote\"\x01");
  EXPECT_EQ(json->find("x")->number, 0.1);
  EXPECT_EQ(json->find("list")->items.at(0).number, 7);
}

TEST(JsonValue, RefusesInOneSentenceWithTheLine) {
  const auto message = [](const std::string& text) {
    const auto json = parse_json(text, "x.json");
    return json.ok() ? "" : json.error().message;
  };
  EXPECT_EQ(message("{\"a\": 1,\n \"a\": 2}"), "x.json:2: a is there twice");
  EXPECT_EQ(message("[1,\n2"), "x.json:2: a comma or ] is wanted");
  EXPECT_EQ(message("{\"a\" 1}"), "x.json:1: a colon is wanted");
  EXPECT_EQ(message("{a: 1}"), "x.json:1: a key in quotes is wanted");
  EXPECT_EQ(message("[nope]"), "x.json:1: a value is wanted");
  EXPECT_EQ(message("\"a\nb\""), "x.json:1: a text does not end in its line");
  EXPECT_EQ(message("1 2"), "x.json:1: nothing is wanted behind the end");
  EXPECT_EQ(message("\"\\ud800\""), "x.json:1: an unknown escape");
  EXPECT_EQ(message(std::string(100, '[')), "x.json:1: nested too deeply");
}

TEST(JsonValue, ACutTextIsAnErrorWhereverItIsCut) {
  const std::string text = "{\"a\": [1, {\"b\": \"\\u00e9\\\\\"}, true], \"c\": null}";
  ASSERT_TRUE(parse_json(text, "x").ok());
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(parse_json(text.substr(0, size), "x").ok()) << size;
}

}  // namespace
}  // namespace fb::lab
