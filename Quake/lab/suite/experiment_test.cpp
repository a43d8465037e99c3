// Suites of experiments: what is read, what is refused, and that those of the project are whole.
#include "lab/suite/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/test_directory.h"

namespace fb::lab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ExperimentTest : public testing::Test {
 protected:
  Result<ExperimentSuite> read(const std::string& text) {
    directory_.put("suite.json", text);
    return read_experiments(directory_.file("suite.json"));
  }
  // Of an experiment with these members, on its second line.
  std::string message(const std::string& members) {
    const auto suite = read("{\"configurations\": {\"pt\": {}}, \"experiments\": [\n{" + members + "}]}");
    return suite.ok() ? "" : suite.error().message;
  }
  const TestDirectory directory_;
};

TEST_F(ExperimentTest, HasWhatTheSuiteSaysUnlessItSaysOtherwise) {
  const auto suite =
      read(R"({"title": "T", "size": [8, 4], "repeats": 3, "reference_samples": 64, "set": {"r_bounces": 4},
    "configurations": {"pt": {"r_estimator": "pt"}, "two": {"r_spp": 2}},
    "experiments": [
      {"name": "a", "view": {"name": "v", "scene": "cbox", "frames": [0, 3], "set": {"r_spp": 5}}},
      {"name": "b", "size": [2, 2], "repeats": 1, "errors": false, "configurations": {"nee": {"r_estimator": "nee"}},
       "view": {"name": "w", "scene": "many", "frames": [0, 1]},
       "vary": {"what": "lights", "scene": "many", "values": [1, 10]}},
      {"name": "c", "view": {"name": "x", "scene": "cbox", "frames": [0, 0]},
       "vary": {"what": "pixels", "sizes": [[2, 3], [4, 5]]}}]})");
  ASSERT_TRUE(suite.ok()) << suite.error().message;
  ASSERT_EQ(suite->experiments.size(), 3u);
  const Experiment &a = suite->experiments[0], &b = suite->experiments[1], &c = suite->experiments[2];
  EXPECT_EQ(a.size, uvec2(8, 4));
  EXPECT_EQ(a.repeats, 3u);
  EXPECT_TRUE(a.errors);
  EXPECT_THAT(a.view.sets, ElementsAre("r_bounces=4", "r_spp=5"));
  ASSERT_EQ(a.configurations.size(), 2u);
  EXPECT_THAT(a.configurations[1].sets, ElementsAre("r_spp=2"));
  EXPECT_EQ(b.size, uvec2(2, 2));
  EXPECT_EQ(b.configurations[0].name, "nee");
  EXPECT_FALSE(b.errors);
  EXPECT_EQ(view_at(b, 1).scene, "many:10");
  EXPECT_EQ(size_at(c, 1), uvec2(4, 5));
  EXPECT_EQ(c.vary.values[1], 20.0);
  const auto pieces = pieces_of(*suite);
  EXPECT_EQ(pieces.size(), 3u + 2u + 2u * 3u);
  EXPECT_EQ(piece_name(*suite, pieces[4]), "b.1.0");
}

TEST_F(ExperimentTest, RefusesInOneSentenceWithFileAndLine) {
  const std::string view = R"("view": {"name": "v", "scene": "cbox", "frames": [0, 3]})";
  ASSERT_EQ(message("\"name\": \"a\", " + view), "");
  EXPECT_THAT(message(view), HasSubstr("suite.json: line 2: experiments[0]: \"name\""));
  EXPECT_THAT(message("\"name\": \"a\""), HasSubstr("\"view\" is wanted"));
  EXPECT_THAT(message("\"name\": \"a\", \"repeats\": 0, " + view), HasSubstr("from 1 to 1000"));
  EXPECT_THAT(message("\"name\": \"a\", \"size\": [1], " + view), HasSubstr("[WIDTH, HEIGHT]"));
  EXPECT_THAT(message("\"name\": \"a\", \"titel\": \"x\", " + view),
              HasSubstr("\"titel\" is no key here; \"title\" is"));
  EXPECT_THAT(message("\"name\": \"a\", \"configurations\": {}, " + view), HasSubstr("at least one"));
  EXPECT_THAT(message("\"name\": \"a\", \"vary\": {\"what\": \"x\", \"values\": [1]}, " + view),
              HasSubstr("one of \"setting\""));
  EXPECT_EQ(message("\"name\": \"a\", \"vary\": {\"what\": \"time\", \"values\": [5, 10]}, " + view), "");
  EXPECT_THAT(message("\"name\": \"a\", \"vary\": {\"what\": \"time\", \"values\": [0]}, " + view),
              HasSubstr("milliseconds above 0"));
  EXPECT_THAT(
      message("\"name\": \"a\", \"vary\": {\"what\": \"time\", \"setting\": \"r_spp\", \"values\": [1]}, " + view),
      HasSubstr("none where"));
  EXPECT_THAT(message("\"name\": \"a\", \"vary\": {\"what\": \"x\", \"setting\": \"r_spp\", \"values\": []}, " + view),
              HasSubstr("\"values\": [...]"));
  const std::string schedules = "\"name\": \"a\", \"vary\": {\"what\": \"iterations\", \"schedules\": ";
  EXPECT_EQ(message(schedules + "[\"1,1,2\"]}, " + view), "");
  EXPECT_THAT(message(schedules + "[\"1,0\"]}, " + view), HasSubstr("--schedule 1,0"));
  EXPECT_THAT(message(schedules + "[1]}, " + view), HasSubstr("samples a pixel of each iteration"));
  EXPECT_THAT(message(schedules + "[\"1\"], \"values\": [1]}, " + view), HasSubstr("\"schedules\": ["));
  EXPECT_THAT(message("\"errors\": false, " + schedules + "[\"1\"]}, " + view), HasSubstr("are measured"));
  EXPECT_THAT(read("{\"experiments\": []}").error().message, HasSubstr("\"experiments\": [...] is wanted"));
  const std::string one = "{\"name\": \"a\", " + view + "}";
  EXPECT_THAT(read("{\"configurations\": {\"pt\": {}}, \"experiments\": [" + one + ",\n" + one + "]}").error().message,
              HasSubstr("line 2: a is there twice"));
}

TEST_F(ExperimentTest, SchedulesAreOfPicturesThatStandStill) {
  const auto suite = read(R"({"configurations": {"mir": {}}, "experiments": [
      {"name": "a", "view": {"name": "v", "scene": "cbox", "frames": [0, 0]},
       "vary": {"what": "iterations", "schedules": ["2,4,8,18", "2,2,28"]}},
      {"name": "b", "view": {"name": "v", "scene": "cbox", "frames": [0, 0]},
       "vary": {"what": "samples", "schedules": ["2,2,4", "doubling:5"]}}]})");
  ASSERT_TRUE(suite.ok()) << suite.error().message;
  const Experiment &a = suite->experiments[0], &b = suite->experiments[1];
  EXPECT_TRUE(a.hold);
  EXPECT_THAT(a.vary.values, ElementsAre(4.0, 3.0));
  EXPECT_THAT(a.vary.schedules[0], ElementsAre(2u, 4u, 8u, 18u));
  EXPECT_THAT(b.vary.values, ElementsAre(8.0, 16.0));
  EXPECT_EQ(pieces_of(*suite).size(), 4u);
}

TEST_F(ExperimentTest, TheProjectsSuitesAreWhole) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator("testdemos/suites")) {
    if (entry.path().stem().string().starts_with("picture")) continue;  // the judge's
    const auto suite = read_experiments(entry.path().string());
    EXPECT_TRUE(suite.ok()) << suite.error().message;
    if (suite.ok()) {
      EXPECT_FALSE(suite->title.empty()) << entry.path();
    }
    ++read;
  }
  EXPECT_GE(read, 2);
}

TEST_F(ExperimentTest, ViewsThatAreJudgedAreExperiments) {
  directory_.put("views.json", R"({"views": [
      {"name": "a", "scene": "cbox", "frames": [1, 2], "quick": true, "set": {"r_bounces": 4}},
      {"name": "b", "scene": "many", "frames": [3, 3]}]})");
  const std::string head = R"({"size": [8, 4], "repeats": 3, "set": {"r_spp": 2}, "configurations": {"pt": {}}, )";
  const auto suite = read(head + R"("judge": {"views": "views.json"}})");
  ASSERT_TRUE(suite.ok()) << suite.error().message;
  ASSERT_EQ(suite->experiments.size(), 2u);
  EXPECT_TRUE(suite->experiments[0].judged);
  EXPECT_EQ(suite->experiments[0].title, "a: scene cbox, frames 1 to 2 from a cold start");
  EXPECT_THAT(suite->experiments[0].view.sets, ElementsAre("r_spp=2", "r_bounces=4"));
  EXPECT_EQ(suite->experiments[1].size, uvec2(8, 4));
  EXPECT_EQ(suite->experiments[1].repeats, 3u);
  const auto quick = read(head + R"("judge": {"views": "views.json", "quick": true}})");
  ASSERT_TRUE(quick.ok());
  EXPECT_EQ(quick->experiments.size(), 1u);
  EXPECT_NE(quick->hash, suite->hash);
  directory_.put("views.json", R"({"views": [{"name": "a", "scene": "cbox", "frames": [1, 3]}]})");
  EXPECT_NE(read(head + R"("judge": {"views": "views.json"}})")->hash, suite->hash) << "what the views are counts";
  const auto twice = read(head + R"("judge": {"views": "views.json"}, "experiments": [
      {"name": "a", "view": {"name": "a", "scene": "cbox", "frames": [0, 0]}}]})");
  ASSERT_FALSE(twice.ok());
  EXPECT_THAT(twice.error().message, HasSubstr("a is there twice"));
  const auto nothing = read(R"({"configurations": {"pt": {}}, "judge": {"views": "nowhere.json"}})");
  ASSERT_FALSE(nothing.ok());
  EXPECT_THAT(nothing.error().message, HasSubstr("nowhere.json"));
}

}  // namespace
}  // namespace fb::lab
