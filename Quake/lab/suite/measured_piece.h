// A suite's piece of raw samples, as its file says it (Misc/docs/formats.md).
#pragma once

#include <cstdint>

#include "lab/bench/bench_job.h"
#include "lab/iterate/iterate_job.h"
#include "lab/json_reader.h"
#include "lab/suite/experiment.h"

namespace fb::lab {

// `scene`: hash of what was looked at. `reference_error`: root mean square of its pixels' standard errors, relative to
// its mean.
Json measured_piece(const Experiment& experiment, const Piece& piece, const BenchResult& result, std::uint64_t scene,
                    double reference_error);
// The same of a picture in iterations, of one run: times are those of all its samples, of its learning and of its end.
Json iterated_piece(const Experiment& experiment, const Piece& piece, const IterateResult& result, std::uint64_t scene,
                    double reference_error);

}  // namespace fb::lab
