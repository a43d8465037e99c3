// fullbright-lab picture: what a player sees, by several configurations and programs, held to references.
//
// Every judged picture comes from a program of its own (sequence.h). Exposure is fixed to the reference's, so that
// differences of automatic exposure do not count, and each seed starts cold: with nothing learnt and no history. The
// lanes take turns, view by view, seed by seed, in rotating order, so that what disturbs the machine disturbs all
// alike.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/compare/flip.h"
#include "lab/judge/judge_statistics.h"
#include "lab/judge/judged_reference.h"
#include "lab/judge/sequence.h"
#include "lab/judge/suite.h"

namespace fb::lab {

struct JudgeJob {
  std::vector<Lane> lanes;        // gains are over the first
  std::vector<std::string> sets;  // "cvar=value", for all lanes
  std::uint32_t width = 320, height = 180;
  std::uint32_t seeds = 4;
  std::uint32_t first_seed = 1;  // r_seed of the first; the reference has another
  double pixels_per_degree = flip::kPixelsPerDegree;
  std::string device;
  std::string scratch;       // folder for the sequences' files
  std::string pictures;      // folder for pictures to look at, one a view; empty: none
  std::string picture_name;  // of its file; empty: the view's
  SequenceRunner runner = run_sequence;
};

struct JudgedView {
  SuiteView view;
  float exposure = 1;
  ViewFigures figures;
};
// `references`: one for each judged frame, or one for all of a view that stands still. `done` is told of every sequence
// that has been run.
Result<JudgedView> judge_view(const SuiteView& view, const std::string& basedir,
                              const std::vector<JudgedReference>& references, const JudgeJob& job,
                              const std::function<void()>& done);

// The largest difference, in steps of 1/255, between what a program shows of a scene and what this program's tone curve
// makes of the radiance it writes: rounding and dither give 1 at most. Above that the program has another curve, and
// its errors contain the difference.
Result<double> tone_curve_difference(const Program& program, const JudgeJob& job);
constexpr double kSameToneCurve = 1.1;

}  // namespace fb::lab
