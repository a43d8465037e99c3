// fullbright-lab iterate: error and time of offline renderings in iterations.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "base/log.h"
#include "host/lab/lab_measured.h"
#include "host/lab/lab_numbers.h"
#include "lab/image_io.h"
#include "lab/iterate/iterate_report.h"

namespace fb::host {
namespace {

struct IterateOptions {
  MeasuredOptions measured;
  std::string schedule = "doubling:6";
  std::uint32_t frame = 0;
};

Status write_pictures(const std::string& prefix, const lab::IterateResult& result) {
  for (const lab::IteratedConfiguration& c : result.configurations) {
    lab::ExrImage exr(c.first.width, c.first.height);
    exr.add_colors("", c.first.pixels);
    if (auto status = lab::write_exr(fmt::format("{}{}.exr", prefix, c.name), exr); !status) return status;
  }
  return ok_status();
}

int run_iterate(const IterateOptions& o, const std::string& command) {
  const MeasuredOptions& options = o.measured;
  if (options.json == "-") set_log_level(LogLevel::kWarning);  // standard output has only the report
  const auto schedule = lab::parse_schedule(o.schedule);
  if (!schedule) return fail(schedule.error());
  Measured m;
  if (auto status = open_measured(m, options, {o.frame, o.frame, 0, true, options.stage.fps}); !status)
    return fail(status.error());
  lab::IterateJob job;
  job.configurations = m.configurations;
  job.schedule = *schedule;
  job.width = m.stage.size.x;
  job.height = m.stage.size.y;
  job.runs = options.runs;
  job.metrics.epsilon = options.epsilon;
  job.quiet = options.stage.quiet;
  const auto result = lab::run_iterate(*m.stage.device, m.view, m.references.front(), job);
  if (!result) return fail(result.error());
  const lab::BenchTitle title = title_of(options, command, fmt::format("frame {}", o.frame));
  if (options.json != "-") fmt::print("{}", lab::iterate_table(*result, title));
  if (!options.json.empty())
    if (auto status = write_text(options.json, lab::iterate_json(*result, title)); !status) return fail(status.error());
  if (!options.stage.out.empty())
    if (auto status = write_pictures(options.stage.out, *result); !status) return fail(status.error());
  return m.stage.device->validation_messages() == 0 ? 0 : 1;
}

}  // namespace

LabCommand add_iterate_command(CLI::App& app, std::string command_line) {
  auto o = std::make_shared<IterateOptions>();
  o->measured.stage.size = "320x180";
  o->measured.runs = lab::kFewestRuns;
  CLI::App* iterate = app.add_subcommand(
      "iterate",
      "measures offline rendering in iterations: each run begins with nothing learnt, takes the samples of a schedule "
      "on a view that stands still and ends with one picture, which is compared with a reference; time is that of all "
      "that ran; gains are relative to the first configuration");
  add_measured_options(*iterate, o->measured);
  add_number(*iterate, "--frame", o->frame, 0u, kMostFrames, "the frame that is held still");
  iterate
      ->add_option("--schedule", o->schedule,
                   "samples a pixel of each iteration: 1,1,2,4, or doubling:N for N iterations of 1, 1, 2, 4, ...")
      ->capture_default_str();
  iterate->add_option("--out", o->measured.stage.out,
                      "PREFIX: write the first run's picture of each configuration to PREFIXNAME.exr");
  return {iterate, [o, command_line = std::move(command_line)] { return run_iterate(*o, command_line); }};
}

}  // namespace fb::host
