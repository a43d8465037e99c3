// Programs and their command lines, with small scripts in the place of old programs.
#include "lab/judge/sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/test_directory.h"
#include "lab/judge/program.h"

namespace fb::lab {
namespace {

using ::testing::HasSubstr;

class SequenceTest : public ::testing::Test {
 protected:
  std::string script(const std::string& name, const std::string& text) {
    directory_.put(name, "#!/bin/sh\n" + text + "\n");
    std::filesystem::permissions(directory_.file(name), std::filesystem::perms::owner_all);
    return directory_.file(name);
  }
  const TestDirectory directory_;
};

TEST_F(SequenceTest, ProgramsAreRunToTheirEnd) {
  const auto end = run_program({script("a", "echo \"$1|$2\"; echo beside >&2; exit 3"), "two words", "it's"});
  ASSERT_TRUE(end.ok()) << end.error().message;
  EXPECT_EQ(end->status, 3);
  EXPECT_EQ(end->output, "two words|it's\nbeside\n");
  EXPECT_EQ(run_program({script("b", "kill -9 $$")})->status, 128 + 9);
  EXPECT_THAT(run_program({directory_.file("none")}).error().message, HasSubstr("none: cannot be started"));
}

TEST_F(SequenceTest, AProgramSaysWhatItWrites) {
  const auto now = open_program("now", script("now", "echo '--denoised --format TEXT:{png,exr,both}'"));
  const auto old = open_program("old", script("old", "echo '--denoised --format TEXT:{png,exr} in both cases'"));
  ASSERT_TRUE(now.ok() && old.ok());
  EXPECT_TRUE(now->writes_both);
  EXPECT_FALSE(old->writes_both);
  EXPECT_THAT(open_program("x", script("x", "echo nothing")).error().message, HasSubstr("is no fullbright-lab"));
}

TEST_F(SequenceTest, TheCommandLineIsRenders) {
  SuiteView view;
  view.demo = "testdemos/hub.dem";
  view.camera = "-1,2,3,0,0,0";
  view.first = 300;
  view.last = 301;
  view.warmup = 32;
  view.sets = {"fov=70"};
  const Lane lane{"a", {"this", "lab", true}, "nee", 4, {"r_x=1"}};
  const SequenceRequest request{&lane, &view, "game", "", 64, 36, {"r_seed=5"}, "out/x"};
  const std::vector<std::string> wanted{"lab",
                                        "render",
                                        "--quiet",
                                        "--timing",
                                        "--denoised",
                                        "--demo",
                                        "testdemos/hub.dem",
                                        "--basedir",
                                        "game",
                                        "--camera=-1,2,3,0,0,0",
                                        "--fps",
                                        "60",
                                        "--estimator",
                                        "nee",
                                        "--spp",
                                        "4",
                                        "--size",
                                        "64x36",
                                        "--frames",
                                        "268:301",
                                        "--set",
                                        "fov=70",
                                        "--set",
                                        "r_x=1",
                                        "--set",
                                        "r_seed=5",
                                        "--format",
                                        "both",
                                        "--out",
                                        "out/x"};
  EXPECT_EQ(render_arguments(request, "both"), wanted);
}

TEST_F(SequenceTest, TimesAreReadFromTheReport) {
  const PassTimes times = parse_times(
      "a line\n"
      "pose             0.500 ms a frame, first 1\n"
      "gbuffer         12.250 ms a frame, first 30\n"
      "paths          100.000 ms a frame, first 200\n"
      "guide states     1.500 ms a frame, first 2\n"
      "guide cache      0.500 ms a frame, first 2\n"
      "denoise_temporal     5.000 ms a frame, first 2\n"
      "denoise_wavelets     4.000 ms a frame, first 2\n"
      "all            123.750 ms a frame (sum of the passes' medians)\n");
  EXPECT_EQ(times.gbuffer, 12.25);
  EXPECT_EQ(times.paths, 102);
  EXPECT_EQ(times.denoiser, 9);
  EXPECT_EQ(times.all, 123.75);
  ASSERT_EQ(times.passes.size(), 7u);
  EXPECT_EQ(times.passes[3].name, "guide states");
  EXPECT_TRUE(times.passes[3].estimators);
  EXPECT_FALSE(times.passes[0].estimators);
}

TEST_F(SequenceTest, APassCountsForTheEstimatorByItsKind) {
  const PassTimes times = parse_times(
      "gbuffer         12.000 ms a frame, first 30\n"
      "guide reset      3.000 ms a frame, first 3\n"
      "seen             1.000 ms a frame, first 3, of the estimator\n"
      "fog              4.000 ms a frame, first 3, of the estimator\n"
      "all             20.000 ms a frame (sum of the passes' medians)\n");
  EXPECT_EQ(times.paths, 5) << "where a program tells kinds, names count for nothing";
  EXPECT_EQ(times.all, 20);
}

TEST_F(SequenceTest, AFailureIsOneSentenceAndLeavesNothing) {
  SuiteView view;
  view.name = "box";
  view.scene = "cbox";
  Lane lane{"a",
            {"old", script("fails", "mkdir -p \"$0.out\"; echo first; echo 'no such estimator'; exit 1"), false},
            "pt",
            1,
            {}};
  const SequenceRequest request{&lane, &view, "", "", 8, 8, {}, directory_.file("fails.out")};
  const auto sequence = run_sequence(request);
  ASSERT_FALSE(sequence.ok());
  EXPECT_THAT(sequence.error().message, HasSubstr("box, a: "));
  EXPECT_THAT(sequence.error().message, HasSubstr("ended with status 1: no such estimator"));
  EXPECT_FALSE(std::filesystem::exists(request.folder));
}

}  // namespace
}  // namespace fb::lab
