#include "host/lab/lab_measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "host/lab/lab_numbers.h"
#include "render/passes/settings.h"

namespace fb::host {
namespace {

Result<std::vector<lab::Configuration>> configurations_of(con::Console& console, const MeasuredOptions& o) {
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

// The reference, and whether its samples cover the whole pixel (r_jitter).
struct KnownReference {
  lab::Reference reference;
  std::optional<int> jitter;
  std::string view;  // that it is of; empty: it does not say
};
Result<KnownReference> read_reference(const std::string& path) {
  auto picture = lab::read_exr_picture(path);
  if (!picture) return picture.error();
  if (auto status = lab::check_reference(picture->content, path); !status) return status.error();
  KnownReference known{std::move(picture->content), std::nullopt, ""};
  if (const auto text = picture->texts.find("fullbright.view"); text != picture->texts.end())
    known.view = text->second.substr(0, text->second.find(" --frame"));
  if (const auto text = picture->texts.find("fullbright.jitter"); text != picture->texts.end())
    known.jitter = text->second == "1" ? 1 : 0;
  return known;
}

int jitter_of(const render::RenderSettings& settings, const std::optional<KnownReference>& known) {
  if (known && known->jitter) return *known->jitter;
  return std::max(settings.jitter, 0);
}

}  // namespace

void add_measured_options(CLI::App& app, MeasuredOptions& o) {
  add_stage_options(app, o.stage);
  app.add_option("--estimators", o.estimators, "one configuration for each of these estimators: pt,mcpg");
  app.add_option("--config", o.configurations,
                 "NAME:cvar=value,...: a configuration set by the renderer's cvars (r_estimator too); may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  add_number(app, "--repeats", o.runs, 1u, 10000u, "runs; each starts with nothing learnt and has its own seed");
  app.add_option("--reference", o.reference, "EXR made by `reference`, for a still view; default: render one");
  add_number(app, "--reference-spp", o.reference_spp, 32u, kMostSamples,
             "samples per pixel of a reference rendered here");
  app.add_option("--reference-estimator", o.reference_estimator,
                 "an unbiased estimator for references rendered here; nee finds small lamps")
      ->capture_default_str();
  app.add_option("--reference-dir", o.reference_folder, "folder in which rendered references are kept and found again");
  add_number(app, "--epsilon", o.epsilon, 1e-30, 1e30, "added to r^2 in the denominator of relMSE");
  app.add_option("--json", o.json, "write JSON to this file; - is standard output, and omits the table");
}

Status open_measured(Measured& m, const MeasuredOptions& o, const lab::ViewOptions& frames) {
  Stage& stage = m.stage;
  if (auto status = open_stage(stage, o.stage); !status) return status;
  con::Console& console = stage.console();
  console.set("r_spp", std::to_string(o.stage.spp));
  console.set("r_estimator", o.stage.estimator);
  stage.settings = render::read_render_settings(console);
  auto configurations = configurations_of(console, o);
  if (!configurations) return configurations.error();
  m.configurations = std::move(*configurations);
  if (auto status = unbiased_estimator(o.reference_estimator, "--reference-estimator"); !status) return status;
  std::optional<KnownReference> known;
  if (!o.reference.empty()) {
    auto read = read_reference(o.reference);
    if (!read) return read.error();
    known = std::move(*read);
    if (!known->view.empty() && known->view != view_text(o.stage))
      fmt::print(stderr, "fullbright-lab: --reference {}: it is of `{}`, and this view is `{}`\n", o.reference,
                 known->view, view_text(o.stage));
  }
  const int jitter = jitter_of(stage.settings, known);
  stage.settings.jitter = jitter;
  for (lab::Configuration& c : m.configurations) c.settings.jitter = jitter;

  auto view = lab::collect_view(*stage.source, frames);
  if (!view) return view.error();
  m.view = std::move(*view);
  stage.renderer.reset();
  if (known) {
    if (!m.view.still) return Error{"--reference " + o.reference + ": the view moves; leave it out, or --hold a frame"};
    m.references = {std::move(known->reference)};
    return ok_status();
  }
  const lab::ReferenceOptions options{o.reference_estimator, o.reference_spp,    stage.size.x,
                                      stage.size.y,          o.reference_folder, o.stage.quiet};
  auto made = lab::make_references(m.view, *stage.device, stage.settings, options);
  if (!made) return made.error();
  m.references = std::move(*made);
  return ok_status();
}

lab::BenchTitle title_of(const MeasuredOptions& o, const std::string& command, const std::string& frames) {
  const StageOptions& s = o.stage;
  const std::string what = !s.scene.empty() ? "scene " + s.scene : !s.map.empty() ? "map " + s.map : "demo " + s.demo;
  const std::string rendered = fmt::format("{}, {} samples a pixel", o.reference_estimator, o.reference_spp);
  return {command, fmt::format("{}, {}", what, frames), o.reference.empty() ? rendered : o.reference};
}

}  // namespace fb::host
