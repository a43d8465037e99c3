// Suites: what is read, what is refused, and that the two of the project are whole.
#include "lab/judge/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/test_directory.h"
#include "lab/frame_source.h"

namespace fb::lab {
namespace {

using ::testing::HasSubstr;

class SuiteTest : public ::testing::Test {
 protected:
  std::string message(const std::string& views) {
    directory_.put("suite.json", views);
    const auto suite = read_suite(directory_.file("suite.json"));
    return suite.ok() ? "" : suite.error().message;
  }
  const TestDirectory directory_;
};

TEST_F(SuiteTest, ReadsViews) {
  directory_.put("demos/a.dem", "x");
  directory_.put("first.json", R"({"views": [{"name": "box", "scene": "cbox", "frames": [3, 3]}]})");
  directory_.put("sub/suite.json", R"({"include": "../first.json", "views": [
    {"name": "a", "demo": "../demos/a.dem", "data": "librequake", "fps": 20, "frames": [30, 31], "warmup": 24,
     "camera": [1, -2.5, 3, 4, 5, 0], "set": {"fov": 70, "r_x": "y"}, "quick": true},
    {"name": "b", "map": "start", "frames": [0, 2]}]})");
  const auto suite = read_suite(directory_.file("sub/suite.json"));
  ASSERT_TRUE(suite.ok()) << suite.error().message;
  ASSERT_EQ(suite->views.size(), 3u);
  const SuiteView &box = suite->views[0], &a = suite->views[1], &b = suite->views[2];
  EXPECT_EQ(box.scene, "cbox");
  EXPECT_EQ(box.data, SuiteView::Data::kNone);
  EXPECT_EQ(box.frames(), 1u);
  EXPECT_EQ(a.demo, directory_.file("demos/a.dem"));
  EXPECT_EQ(a.data, SuiteView::Data::kLibreQuake);
  EXPECT_EQ(a.camera, "1,-2.5,3,4,5,0");
  EXPECT_EQ(a.sets, (std::vector<std::string>{"fov=70", "r_x=y"}));
  EXPECT_EQ(a.frames_per_second, 20);
  EXPECT_EQ(a.warmup, 24u);
  EXPECT_TRUE(a.quick);
  EXPECT_EQ(b.data, SuiteView::Data::kGame);
  EXPECT_EQ(b.last, 2u);
  EXPECT_FALSE(b.quick);
}

TEST_F(SuiteTest, RefusesInOneSentenceWithThePlace) {
  const auto view = [&](const std::string& members) { return message("{\"views\": [\n{" + members + "}]}"); };
  EXPECT_THAT(view(R"("name": "a", "scene": "cbox")"),
              HasSubstr("suite.json: line 2: views[0]: \"frames\": [FIRST, LAST] is wanted"));
  EXPECT_THAT(view(R"("name": "a", "scene": "cbox", "frames": [2, 1])"), HasSubstr("the last comes before the first"));
  EXPECT_THAT(view(R"("name": "a", "scene": "cbox", "frames": [2, 3], "warmup": 3)"), HasSubstr("only 2 frames"));
  EXPECT_THAT(view(R"("name": "a", "scene": "cbox", "frames": [0, 1.5])"), HasSubstr("a whole number"));
  EXPECT_THAT(view(R"("name": "a b", "scene": "cbox", "frames": [0, 1])"), HasSubstr("letters, digits"));
  EXPECT_THAT(view(R"("name": "a", "frames": [0, 1])"), HasSubstr("one of \"scene\", \"map\" and \"demo\""));
  EXPECT_THAT(view(R"("name": "a", "scene": "x", "map": "y", "frames": [0, 1])"), HasSubstr("one of"));
  EXPECT_THAT(view(R"("name": "a", "scene": "x", "frames": [0, 1], "wramup": 3)"),
              HasSubstr("suite.json: line 2: views[0]: \"wramup\" is no key here; \"warmup\" is"));
  EXPECT_THAT(view(R"("name": "a", "map": "x", "data": "other", "frames": [0, 1])"), HasSubstr("librequake"));
  EXPECT_THAT(message("{\"views\": []}"), HasSubstr("holds no view"));
  EXPECT_THAT(message("{}"), HasSubstr("\"views\""));
  EXPECT_THAT(message(R"({"include": "suite.json", "views": []})"), HasSubstr("include each other"));
  const std::string twice = R"({"name": "a", "scene": "cbox", "frames": [0, 1]})";
  EXPECT_THAT(message("{\"views\": [" + twice + ",\n" + twice + "]}"),
              HasSubstr("suite.json: line 2: a is there twice"));
  EXPECT_THAT(view(R"("name": "a", "name": "b", "scene": "x", "frames": [0, 1])"),
              HasSubstr("line 2: the key \"name\" is there twice"));
  EXPECT_THAT(message("[1]"), HasSubstr("suite.json: an object in { } is wanted"));
  EXPECT_THAT(message("{\"views\": [\n5]}"), HasSubstr("views[0]: an object in { } is wanted"));
  EXPECT_THAT(message(std::string(100000, '[')), HasSubstr("suite.json: "));
  const std::string whole = "{\"views\": [\n" + twice + "]}";
  ASSERT_EQ(message(whole), "");
  EXPECT_THAT(message("{\"views\": [\n{name: 1}]}"), HasSubstr("json: parse error at line 2"));
  for (std::size_t cut = 0; cut < whole.size(); ++cut) EXPECT_NE(message(whole.substr(0, cut)), "") << cut;
  EXPECT_THAT(read_suite(directory_.file("none.json")).error().message, HasSubstr("none.json"));
}

TEST_F(SuiteTest, TheProjectsSuitesAreWhole) {
  const auto all = read_suite("testdemos/suites/picture.json"), free = read_suite("testdemos/suites/picture_free.json");
  const auto water = read_suite("testdemos/suites/picture_water.json");
  ASSERT_TRUE(water.ok()) << water.error().message;
  ASSERT_TRUE(all.ok()) << all.error().message;
  ASSERT_TRUE(free.ok()) << free.error().message;
  EXPECT_GT(all->views.size(), free->views.size());
  int quick = 0;
  const auto scenes = code_scene_names();
  for (const SuiteView& view : free->views) {
    EXPECT_NE(view.data, SuiteView::Data::kLibreQuake) << view.name;
    EXPECT_GE(view.frames(), 2u) << view.name << ": flicker needs two frames";
    if (!view.scene.empty()) {
      EXPECT_THAT(scenes, ::testing::Contains(view.scene));
    }
    if (!view.demo.empty()) {
      EXPECT_TRUE(std::filesystem::exists(view.demo)) << view.demo;
    }
    quick += view.quick ? 1 : 0;
  }
  EXPECT_GE(quick, 3);
}

}  // namespace
}  // namespace fb::lab
