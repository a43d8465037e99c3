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

// Parts of the table, for other reports of such figures.
std::string give_or_take(double error);  // nothing where it is not known
std::string gain_line(std::string_view what, const Estimate& gain);
std::string reference_line(const BenchTitle& title, const ReferenceFigures& figures);
// What to know of the figures of `what`; nothing where they hold: that rare samples rule, that the reference is noisy.
std::string tail_remark(std::string_view what, const WindowStatistics& statistics);
std::string reference_remark(std::string_view what, const WindowStatistics& statistics);

}  // namespace fb::lab
