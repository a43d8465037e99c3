// A bench's result as people, programs and spreadsheets read it.
#pragma once

#include <string>
#include <string_view>

#include "lab/bench/bench_job.h"

namespace fb::lab {

// How the bench was asked for; goes into the report as it is.
struct BenchTitle {
  std::string command, view, reference;
};
std::string bench_table(const BenchResult& result, const BenchTitle& title);
std::string bench_json(const BenchResult& result, const BenchTitle& title);
// A line a configuration, run and frame.
std::string bench_csv(const BenchResult& result);

}  // namespace fb::lab
