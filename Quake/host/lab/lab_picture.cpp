// fullbright-lab picture: the judge of the picture that a player sees.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/log.h"
#include "base/progress.h"
#include "host/base_game.h"
#include "host/lab/judged_view.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/judge/judge_report.h"

namespace fb::host {
namespace {

struct PictureOptions {
  std::string suite, basedir, librequake, size = "320x180", device, json, pictures, references = "out/references";
  std::string reference_estimator = "nee";
  std::vector<std::string> estimators, configurations, programs, sets, reference_sets, views;
  std::uint32_t seeds = 4, reference_spp = 2048;
  bool quick = false, references_only = false, quiet = false;
};

// What --quick chooses where nothing else is said.
void choose_quick(PictureOptions& o, const CLI::App& app) {
  if (!o.quick) return;
  if (app.count("--size") == 0) o.size = "160x90";
  if (app.count("--seeds") == 0) o.seeds = 4;
  if (app.count("--reference-spp") == 0) o.reference_spp = 512;
}

struct PlacedView {
  lab::SuiteView view;
  std::string basedir;
  std::vector<lab::JudgedReference> references;
};

Result<std::vector<PlacedView>> place_views(const PictureOptions& o, std::vector<std::string>& skipped) {
  auto suite = lab::read_suite(o.suite);
  if (!suite) return suite.error();
  std::vector<std::string> chosen;
  for (const std::string& names : o.views)
    for (std::string& name : split(names, ',')) chosen.push_back(std::move(name));
  for (const std::string& name : chosen) {
    const auto named = [&](const lab::SuiteView& view) { return view.name == name; };
    if (std::none_of(suite->views.begin(), suite->views.end(), named))
      return Error{fmt::format("--views {}: there is no such view in {}", name, o.suite)};
  }
  std::vector<PlacedView> placed;
  for (lab::SuiteView& view : suite->views) {
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), view.name) == chosen.end()) continue;
    if (chosen.empty() && o.quick && !view.quick) continue;
    Place place = place_of(view, o.basedir, o.librequake);
    if (place.missing.empty())
      placed.push_back({std::move(view), std::move(place.basedir), {}});
    else
      skipped.push_back(std::move(place.missing));
  }
  if (placed.empty())
    return Error{
        fmt::format("{}: there is nothing to judge{}", o.suite, skipped.empty() ? "" : "; " + skipped.front())};
  return placed;
}

Status judge_views(std::vector<PlacedView>& views, const PictureOptions& o, const lab::JudgeJob& job,
                   const lab::JudgeTitle& title) {
  const bool tables = o.json != "-";
  if (tables) fmt::print("{}", lab::judge_heading(job, title));
  std::vector<lab::JudgedView> judged;
  std::uint64_t done = 0;
  Progress progress("sequence", views.size() * job.lanes.size() * job.seeds, {.quiet = o.quiet, .lines = true});
  for (PlacedView& placed : views) {
    auto view = lab::judge_view(placed.view, placed.basedir, placed.references, job, [&] { progress.update(++done); });
    if (!view) return view.error();
    placed.references.clear();
    if (tables) {
      fmt::print("{}", lab::view_table(*view, job));
      std::fflush(stdout);
    }
    judged.push_back(std::move(*view));
  }
  if (tables) fmt::print("{}", lab::summary_table(judged, job));
  return o.json.empty() ? ok_status() : write_text(o.json, lab::judge_json(judged, job, title));
}

Status run_picture(const PictureOptions& o, const std::string& command) {
  const auto size = parse_size(o.size);
  if (!size) return Error{"--size: " + size.error().message};
  std::string reference = fmt::format("{}, {} samples a pixel", o.reference_estimator, o.reference_spp);
  for (const std::string& set : o.reference_sets) reference += ", " + set;
  lab::JudgeTitle title{command, o.suite, "", std::move(reference), {}, {}};
  if (auto status = known_estimator(o.reference_estimator, "--reference-estimator"); !status) return status;
  auto views = place_views(o, title.skipped);
  if (!views) return views.error();
  const auto programs = open_programs(o.programs);
  if (!programs) return programs.error();
  const auto texts = parse_configurations(o.estimators, o.configurations, lab::Lane().estimator);
  if (!texts) return texts.error();
  auto lanes = lanes_of(*texts, *programs);
  if (!lanes) return lanes.error();
  lab::JudgeJob job;
  job.lanes = std::move(*lanes);
  job.sets = o.sets;
  job.width = size->x;
  job.height = size->y;
  job.seeds = o.seeds;
  job.device = o.device;
  job.scratch = scratch_folder();
  job.pictures = o.pictures;
  if (!o.references_only) {
    auto curves = other_tone_curves(*programs, job);
    if (!curves) return curves.error();
    title.other_curves = std::move(*curves);
  }
  std::vector<std::string> reference_sets = o.sets;
  reference_sets.insert(reference_sets.end(), o.reference_sets.begin(), o.reference_sets.end());
  for (std::size_t i = 0; i < views->size(); ++i) {
    PlacedView& placed = (*views)[i];
    const std::string label = fmt::format("view {} of {}, {}", i + 1, views->size(), placed.view.name);
    auto truth = find_truth(placed.view, placed.basedir, reference_sets, o.device,
                            {o.reference_estimator, o.reference_spp, size->x, size->y, o.references, label, o.quiet});
    if (!truth) return truth.error();
    title.device = truth->device;
    if (!o.references_only) placed.references = std::move(truth->references);
  }
  if (!o.references_only) return judge_views(*views, o, job, title);
  for (const std::string& line : title.skipped) fmt::print("{}\n", line);
  fmt::print("references of {} views are in {}\n", views->size(), o.references);
  return ok_status();
}

void add_options(CLI::App& app, PictureOptions& o) {
  // One value each time, so that SUITE may stand behind it.
  const auto repeated = [](CLI::Option* option) { option->expected(1)->take_all()->allow_extra_args(false); };
  app.add_option("SUITE", o.suite, "the views: a JSON file, such as testdemos/suites/picture.json")->required();
  repeated(app.add_option("--estimators", o.estimators, "one configuration for each of these estimators: pt,mcpg"));
  repeated(
      app.add_option("--config", o.configurations,
                     "NAME:cvar=value,...: a configuration set by cvars (r_estimator, r_spp, ...), run by every "
                     "program; NAME@PROGRAM:... by that one alone (the program itself is `this`); may be repeated; "
                     "default: nee, as in the game, 1 sample"));
  repeated(app.add_option("--binary", o.programs,
                          "NAME=PROGRAM: another fullbright-lab, an older one for example, judged beside this one; may "
                          "be repeated"));
  repeated(app.add_option("--set", o.sets, "cvar=value, for references and all configurations; may be repeated"));
  repeated(app.add_option("--reference-set", o.reference_sets,
                          "cvar=value, for references alone (r_bounces=16: all reflections); may be repeated"));
  repeated(app.add_option("--views", o.views, "the views to judge, by their names: hub_300,start; default: all"));
  app.add_flag("--quick", o.quick,
               "only the views that the suite calls quick; 160x90, 4 seeds and references of 512 samples unless other "
               "options say otherwise");
  app.add_option("--size", o.size, "WIDTHxHEIGHT")->capture_default_str();
  add_number(app, "--seeds", o.seeds, 1u, 1000u, "sequences of each view and configuration; intervals are over these");
  app.add_option("--references", o.references, "folder in which references are kept and found again")
      ->capture_default_str();
  add_number(app, "--reference-spp", o.reference_spp, 32u, kMostSamples, "samples per pixel of a reference");
  app.add_option("--reference-estimator", o.reference_estimator, "an unbiased estimator that finds small lamps")
      ->capture_default_str();
  app.add_flag("--references-only", o.references_only, "make the missing references and judge nothing");
  app.add_option("--basedir", o.basedir, "the base game's folder, which holds id1; default: beside the program");
  app.add_option(
      "--librequake", o.librequake,
      "LibreQuake's folder, which holds id1; default: FULLBRIGHT_TEST_DATA, else ../shared/librequake; views "
      "of what is not there are skipped");
  app.add_option("--device", o.device, "Vulkan device: part of its name, or its index in `fullbright -listdevices`");
  app.add_option("--json", o.json, "write JSON to this file; - is standard output, and omits the tables");
  app.add_option(
      "--pictures", o.pictures,
      "write VIEW.png to this folder: the reference and the configurations, below them silhouettes and FLIP");
  app.add_flag("--quiet", o.quiet, "print no progress");
}

}  // namespace

LabCommand add_picture_command(CLI::App& app, std::string command_line) {
  auto o = std::make_shared<PictureOptions>();
  CLI::App* picture = app.add_subcommand(
      "picture",
      "judges the picture that a player sees, denoised, anti-aliased and tone mapped, over a suite of views: FLIP, "
      "relative "
      "error, bias, flicker, isolated pixels, silhouettes and time, against references of many samples");
  add_options(*picture, *o);
  return {picture, [o, picture, command_line = std::move(command_line)] {
            choose_quick(*o, *picture);
            set_log_level(LogLevel::kWarning);  // the games' starts are no part of the report
            const auto status = run_picture(*o, command_line);
            return status ? 0 : fail(status.error());
          }};
}

}  // namespace fb::host
