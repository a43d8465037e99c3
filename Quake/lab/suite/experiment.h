// Experiments: views times configurations times what is varied, read from a JSON file (Misc/docs/formats.md). Each is a
// number of pieces, which depend on nothing but the file, so that they can be made one by one, by many machines, again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "lab/iterate/schedule.h"
#include "lab/judge/suite.h"

namespace fb::lab {

struct ExperimentConfiguration {
  std::string name;
  std::vector<std::string> sets;  // "cvar=value", the renderer's own
};

struct Experiment {
  std::string name, title;             // the name names files
  std::string source, paper, differs;  // a figure of a paper, what it has, what differs here; may be empty
  SuiteView view;                      // frames: those that are measured; warm-up before them
  bool hold = false;                   // its first frame stands still for all of them
  std::vector<ExperimentConfiguration> configurations;  // gains are relative to the first
  // What is varied: a setting, the count of a scene's things, the picture's size, the time that each configuration may
  // take for a frame, for which it takes as many samples as fit, or the iterations of an offline picture.
  struct Vary {
    std::string what;  // "samples", "lights", "pixels" ...; empty: nothing, and there is one value, 0
    std::string setting, scene;
    std::vector<double> values{0.0};
    std::vector<uvec2> sizes;                        // as many as values, which are their pixels; or none
    std::vector<Schedule> schedules;                 // as many as values: how many iterations, or samples; or none
    bool of_time() const { return what == "time"; }  // values: milliseconds of the estimator's own passes
    bool of_schedules() const { return !schedules.empty(); }
  } vary;
  uvec2 size{96, 54};
  std::uint32_t repeats = 1;  // each starts with nothing learnt and has its own seed
  std::uint32_t reference_samples = 1024;
  std::string reference_estimator = "nee";
  bool errors = true;    // else only times are measured, and no reference is made
  bool picture = false;  // keeps the mean of the first repeat's frames
  // The picture that a player sees is judged (judge/judge_job.h), in place of raw samples. Configurations are then
  // lanes: a name may end in @PROGRAM.
  bool judged = false;
};

struct ExperimentSuite {
  std::string title;
  std::vector<Experiment> experiments;
  std::uint64_t hash = 0;  // of all that it says
};
// `"judge": {"views": FILE, "quick": true}` makes an experiment of each view of a file (judge/suite.h), or of its quick
// ones. Fails with the file, the line and the cause.
Result<ExperimentSuite> read_experiments(const std::string& path);

struct Piece {
  std::size_t experiment = 0, value = 0;
  std::uint32_t repeat = 0;
  bool operator==(const Piece&) const = default;
};
// In the order in which they are best made: those of one view behind each other.
std::vector<Piece> pieces_of(const ExperimentSuite& suite);
// Names its file: "cbox.2.0".
std::string piece_name(const ExperimentSuite& suite, const Piece& piece);
// The view and the picture's size at a value.
SuiteView view_at(const Experiment& experiment, std::size_t value);
uvec2 size_at(const Experiment& experiment, std::size_t value);

}  // namespace fb::lab
