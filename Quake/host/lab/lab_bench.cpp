// fullbright-lab bench: speed and error of configurations side by side.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/log.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/bench/bench_report.h"

namespace fb::host {
namespace {

struct BenchOptions {
  StageOptions stage;
  std::string frames = "0:31", reference, reference_folder, reference_estimator = "pt", json, csv;
  std::vector<std::string> estimators, configurations;
  std::uint32_t reference_spp = 4096, warmup = 0, runs = 1;
  double epsilon = lab::MetricOptions().epsilon;
  bool hold = false;
};

Result<std::vector<lab::Configuration>> configurations_of(con::Console& console, const BenchOptions& o) {
  const auto texts = parse_configurations(o.estimators, o.configurations, o.stage.estimator);
  if (!texts) return texts.error();
  std::vector<lab::Configuration> list;
  for (const ConfigurationText& text : *texts) {
    auto configuration = configuration_of(console, text, "--config " + text.name);
    if (!configuration) return configuration.error();
    list.push_back(std::move(*configuration));
  }
  return list;
}

std::string view_title(const BenchOptions& o) {
  const StageOptions& s = o.stage;
  const std::string what = !s.scene.empty() ? "scene " + s.scene : !s.map.empty() ? "map " + s.map : "demo " + s.demo;
  return fmt::format("{}, frames {}", what, o.frames);
}

// The reference, and whether its samples cover the whole pixel (r_jitter).
struct KnownReference {
  lab::Reference reference;
  std::optional<int> jitter;
};
Result<KnownReference> read_reference(const std::string& path) {
  auto picture = lab::read_exr_picture(path);
  if (!picture) return picture.error();
  KnownReference known{std::move(picture->content), std::nullopt};
  if (const auto text = picture->texts.find("fullbright.jitter"); text != picture->texts.end())
    known.jitter = text->second == "1" ? 1 : 0;
  return known;
}

// Frames and reference have the same jitter: the reference file's if there is one, else r_jitter, where -1 (only while
// accumulating) means none.
int jitter_of(const render::RenderSettings& settings, const std::optional<KnownReference>& known) {
  if (known && known->jitter) return *known->jitter;
  return std::max(settings.jitter, 0);
}

Status write_reports(const BenchOptions& o, const lab::BenchResult& result, const std::string& command) {
  lab::BenchTitle title{command, view_title(o), o.reference};
  if (o.reference.empty())
    title.reference = fmt::format("{}, {} samples a pixel", o.reference_estimator, o.reference_spp);
  if (o.json != "-" && o.csv != "-") fmt::print("{}", lab::bench_table(result, title));
  if (!o.json.empty()) {
    if (auto status = write_text(o.json, lab::bench_json(result, title)); !status) return status;
  }
  return o.csv.empty() ? ok_status() : write_text(o.csv, lab::bench_csv(result));
}

Result<lab::BenchResult> run_on_stage(Stage& stage, const BenchOptions& o, lab::BenchJob& job) {
  const auto range = parse_frames(o.frames);
  if (!range) return range.error();
  if (auto status = unbiased_estimator(o.reference_estimator, "--reference-estimator"); !status) return status.error();
  std::optional<KnownReference> known;
  if (!o.reference.empty()) {
    auto read = read_reference(o.reference);
    if (!read) return read.error();
    known = std::move(*read);
  }
  const int jitter = jitter_of(stage.settings, known);
  stage.settings.jitter = jitter;
  for (lab::Configuration& c : job.configurations) c.settings.jitter = jitter;

  const bool hold = o.hold || !o.stage.map.empty();
  auto view = lab::collect_view(*stage.source, {range->first, range->second, o.warmup, hold, o.stage.fps});
  if (!view) return view.error();
  std::vector<lab::Reference> references;
  if (known) {
    if (!view->still) return Error{"--reference " + o.reference + ": the view moves; leave it out, or --hold a frame"};
    references.push_back(std::move(known->reference));
  } else {
    const lab::ReferenceOptions options{o.reference_estimator, o.reference_spp,    stage.size.x,
                                        stage.size.y,          o.reference_folder, o.stage.quiet};
    auto made = lab::make_references(*view, *stage.device, stage.settings, options);
    if (!made) return made.error();
    references = std::move(*made);
  }
  stage.renderer.reset();  // each configuration has its own
  return lab::run_bench(*stage.device, *view, references, job);
}

int run_bench(const BenchOptions& o, const std::string& command) {
  if (o.json == "-" || o.csv == "-") set_log_level(LogLevel::kWarning);  // standard output has only the report
  Stage stage;
  if (auto status = open_stage(stage, o.stage); !status) return fail(status.error());
  con::Console& console = stage.console();
  console.set("r_spp", std::to_string(o.stage.spp));
  console.set("r_estimator", o.stage.estimator);
  stage.settings = render::read_render_settings(console);
  auto configurations = configurations_of(console, o);
  if (!configurations) return fail(configurations.error());
  lab::BenchJob job;
  job.configurations = std::move(*configurations);
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.runs = o.runs;
  job.metrics.epsilon = o.epsilon;
  job.quiet = o.stage.quiet;
  const auto result = run_on_stage(stage, o, job);
  if (!result) return fail(result.error());
  if (auto status = write_reports(o, *result, command); !status) return fail(status.error());
  return stage.device->validation_messages() == 0 ? 0 : 1;
}

}  // namespace

LabCommand add_bench_command(CLI::App& app, std::string command_line) {
  auto o = std::make_shared<BenchOptions>();
  o->stage.size = "320x180";
  CLI::App* bench = app.add_subcommand(
      "bench",
      "measures speed and error: configurations render one view, interleaved frame by frame; single "
      "frames and their running average are compared with a reference of pt; gains are relative to the "
      "first configuration");
  add_stage_options(*bench, o->stage);
  bench->add_option("--estimators", o->estimators, "one configuration for each of these estimators: pt,mcpg");
  bench
      ->add_option(
          "--config", o->configurations,
          "NAME:cvar=value,...: a configuration set by the renderer's cvars (r_estimator too); may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  bench->add_option("--frames", o->frames, "FIRST:LAST, the measured frames; a still view renders FIRST each time")
      ->capture_default_str();
  add_number(*bench, "--warmup", o->warmup, 0u, kMostFrames,
             "frames rendered before the measured ones, for estimators that learn");
  add_number(*bench, "--repeats", o->runs, 1u, 10000u, "runs; each starts with nothing learnt and has its own seed");
  bench->add_flag("--hold", o->hold, "freeze frame FIRST, with its animation (always so for --map)");
  bench->add_option("--reference", o->reference, "EXR made by `reference`, for a still view; default: render one");
  add_number(*bench, "--reference-spp", o->reference_spp, 32u, kMostSamples,
             "samples per pixel of a reference rendered here");
  bench
      ->add_option("--reference-estimator", o->reference_estimator,
                   "an unbiased estimator for references rendered here; nee finds small lamps")
      ->capture_default_str();
  bench->add_option("--reference-dir", o->reference_folder,
                    "folder in which rendered references are kept and found again");
  add_number(*bench, "--epsilon", o->epsilon, 1e-30, 1e30, "added to r^2 in the denominator of relMSE");
  bench->add_option("--json", o->json, "write JSON to this file; - is standard output, and omits the table");
  bench->add_option("--csv", o->csv, "write CSV, one line per frame, to this file; - is standard output");
  return {bench, [o, command_line = std::move(command_line)] { return run_bench(*o, command_line); }};
}

}  // namespace fb::host
