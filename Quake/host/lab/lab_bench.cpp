// fullbright-lab bench: speed and error of configurations side by side.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "base/log.h"
#include "host/lab/lab_measured.h"
#include "host/lab/lab_numbers.h"

namespace fb::host {
namespace {

struct BenchOptions {
  MeasuredOptions measured;
  std::string frames = "0:31", csv;
  std::uint32_t warmup = 0;
  bool hold = false;
};

Status write_reports(const BenchOptions& o, const lab::BenchResult& result, const std::string& command) {
  const lab::BenchTitle title = title_of(o.measured, command, "frames " + o.frames);
  const std::string& json = o.measured.json;
  if (json != "-" && o.csv != "-") fmt::print("{}", lab::bench_table(result, title));
  if (!json.empty()) {
    if (auto status = write_text(json, lab::bench_json(result, title)); !status) return status;
  }
  return o.csv.empty() ? ok_status() : write_text(o.csv, lab::bench_csv(result));
}

int run_bench(const BenchOptions& o, const std::string& command) {
  const MeasuredOptions& options = o.measured;
  if (options.json == "-" || o.csv == "-") set_log_level(LogLevel::kWarning);  // standard output has only the report
  const auto range = parse_frames(o.frames);
  if (!range) return fail(range.error());
  const bool hold = o.hold || !options.stage.map.empty();
  Measured m;
  if (auto status = open_measured(m, options, {range->first, range->second, o.warmup, hold, options.stage.fps});
      !status)
    return fail(status.error());
  lab::BenchJob job;
  job.configurations = m.configurations;
  job.width = m.stage.size.x;
  job.height = m.stage.size.y;
  job.runs = options.runs;
  job.metrics.epsilon = options.epsilon;
  job.quiet = options.stage.quiet;
  const auto result = lab::run_bench(*m.stage.device, m.view, m.references, job);
  if (!result) return fail(result.error());
  if (auto status = write_reports(o, *result, command); !status) return fail(status.error());
  return m.stage.device->validation_messages() == 0 ? 0 : 1;
}

}  // namespace

LabCommand add_bench_command(CLI::App& app, std::string command_line) {
  auto o = std::make_shared<BenchOptions>();
  o->measured.stage.size = "320x180";
  CLI::App* bench = app.add_subcommand(
      "bench",
      "measures speed and error: configurations render one view, interleaved frame by frame; single "
      "frames and their running average are compared with a reference of pt; gains are relative to the "
      "first configuration");
  add_measured_options(*bench, o->measured);
  bench->add_option("--frames", o->frames, "FIRST:LAST, the measured frames; a still view renders FIRST each time")
      ->capture_default_str();
  add_number(*bench, "--warmup", o->warmup, 0u, kMostFrames,
             "frames rendered before the measured ones, for estimators that learn");
  bench->add_flag("--hold", o->hold, "freeze frame FIRST, with its animation (always so for --map)");
  bench->add_option("--csv", o->csv, "write CSV, one line per frame, to this file; - is standard output");
  return {bench, [o, command_line = std::move(command_line)] { return run_bench(*o, command_line); }};
}

}  // namespace fb::host
