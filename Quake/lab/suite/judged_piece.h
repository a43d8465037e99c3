// A suite's piece of judged pictures, as its file says it (Misc/docs/formats.md), and what all pieces of a suite say
// together: the judge's figures with their intervals.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/json_reader.h"
#include "lab/judge/judge_job.h"
#include "lab/suite/experiment.h"

namespace fb::lab {

// `view`: of one seed. `times`: each lane's. `scene`: hash of what was looked at.
Json judged_piece(const Experiment& experiment, const Piece& piece, const JudgedView& view,
                  const std::vector<Lane>& lanes, const std::vector<PassTimes>& times, std::uint64_t scene);

// The figures of an experiment's points, seeds in their order; `truth` is a piece's.
ViewFigures judged_figures(const Experiment& experiment, const Json& points, const Json& truth);
// A list with an object a configuration: {"configuration", FIGURE: {"value", "interval95"} ...}. Figures that are not
// known are null.
Json judged_estimates(const Experiment& experiment, const ViewFigures& figures);
// The same over experiments that have the first one's configurations, with gains over the first of them.
Json judged_summary(const std::vector<const Experiment*>& experiments, const std::vector<ViewFigures>& figures);

}  // namespace fb::lab
