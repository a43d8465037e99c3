// What the commands that measure configurations against a reference have in common (bench, iterate): their options, and
// the stage, the view and the reference that these ask for.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "host/lab/lab_stage.h"
#include "lab/bench/bench_report.h"
#include "lab/bench/bench_view.h"

namespace fb::host {

struct MeasuredOptions {
  StageOptions stage;
  std::string reference, reference_folder, reference_estimator = "pt", json;
  std::vector<std::string> estimators, configurations;
  std::uint32_t reference_spp = 4096, runs = 1;
  double epsilon = lab::MetricOptions().epsilon;
};
// All but which frames are looked at.
void add_measured_options(CLI::App& app, MeasuredOptions& options);

struct Measured {
  Stage stage;  // without a renderer: each configuration has its own
  std::vector<lab::Configuration> configurations;
  lab::View view;
  std::vector<lab::Reference> references;
};
// Frames and reference have the same jitter: the reference file's if there is one, else r_jitter, where -1 (only while
// accumulating) means none.
Status open_measured(Measured& measured, const MeasuredOptions& options, const lab::ViewOptions& frames);
// `frames`: of the view, as they were asked for.
lab::BenchTitle title_of(const MeasuredOptions& options, const std::string& command, const std::string& frames);

}  // namespace fb::host
