// What iterate found, as people and programs read it.
#pragma once

#include <string>

#include "lab/bench/bench_report.h"
#include "lab/iterate/iterate_job.h"

namespace fb::lab {

std::string iterate_table(const IterateResult& result, const BenchTitle& title);
std::string iterate_json(const IterateResult& result, const BenchTitle& title);

}  // namespace fb::lab
