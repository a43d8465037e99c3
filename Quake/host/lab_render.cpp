// fullbright-lab render and reference: chosen frames, or one with many samples.
#include <fmt/format.h>

#include "host/lab_numbers.h"
#include "host/lab_stage.h"
#include "lab/jobs.h"

namespace fb::host {
namespace {

struct RenderOptions {
  StageOptions stage;
  std::string frames = "0:0", format = "png";
  bool hash = false, denoised = false;
};
struct ReferenceOptions {
  StageOptions stage;
  std::uint64_t frame = 0;
  std::uint32_t warmup = 0;
};

int run_render(const RenderOptions& options) {
  StageOptions o = options.stage;
  if (options.denoised) o.sets.insert(o.sets.begin(), "r_denoise=1");
  auto range = parse_frames(options.frames);
  if (!range) return fail(range.error());
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  lab::RenderJob job;
  std::tie(job.first, job.last) = *range;
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.spp = o.spp;
  job.out = o.out;
  job.format = options.format == "exr"    ? lab::ImageFormat::kExr
               : options.format == "both" ? lab::ImageFormat::kBoth
                                          : lab::ImageFormat::kPng;
  job.hash = options.hash;
  job.quiet = o.quiet;
  const auto summary = lab::render_frames(*stage.source, *stage.renderer, stage.settings, job);
  if (!summary) return fail(summary.error());
  if (o.timing) {
    double total = 0;
    for (const auto& pass : summary->passes) {
      total += pass.median();
      fmt::print("{:12} {:9.3f} ms a frame, first {:.0f}\n", pass.name, pass.median(), pass.milliseconds.front());
    }
    fmt::print("{:12} {:9.3f} ms a frame (sum of the passes' medians)\n", "all", total);
  }
  if (!o.out.empty() && !o.quiet) fmt::print("{} frames in {}\n", summary->frames, o.out);
  return finish(stage);
}

int run_reference(const ReferenceOptions& options) {
  const StageOptions& o = options.stage;
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  lab::ReferenceJob job;
  job.frame = options.frame;
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.spp = o.spp;
  job.warmup = options.warmup;
  job.out = o.out;
  job.quiet = o.quiet;
  const auto summary = lab::render_reference(*stage.source, *stage.renderer, stage.settings, job);
  if (!summary) return fail(summary.error());
  fmt::print("{}: mean luminance {:.6g}, pixels' standard error {:.3g} of it\n", o.out, summary->mean_luminance,
             summary->relative_error);
  return finish(stage);
}

}  // namespace

LabCommand add_render_command(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* render = app.add_subcommand("render", "renders chosen frames at fixed time steps, in order");
  add_stage_options(*render, options->stage);
  render->add_option("--frames", options->frames, "FIRST:LAST, numbers of the frames, from 0")->capture_default_str();
  render->add_option("--out", options->stage.out, "folder for the frames; default: write none");
  render->add_option("--format", options->format, "png, exr (linear, before tone mapping) or both")
      ->check(CLI::IsMember({"png", "exr", "both"}))
      ->capture_default_str();
  render->add_flag("--denoised", options->denoised, "write the denoised picture, as the game shows it (r_denoise 1)");
  render->add_flag("--hash", options->hash, "print a hash of each frame's linear image");
  return {render, [options] { return run_render(*options); }};
}

LabCommand add_reference_command(CLI::App& app) {
  auto options = std::make_shared<ReferenceOptions>();
  CLI::App* reference =
      app.add_subcommand("reference", "averages many samples of one frame and writes mean and variance to an EXR file");
  add_stage_options(*reference, options->stage);
  add_number(*reference, "--frame", options->frame, std::uint64_t{0}, std::uint64_t{kMostFrames},
             "number of the frame, from 0");
  add_number(*reference, "--warmup", options->warmup, 0u, kMostSamples,
             "samples per pixel discarded at the start, from which an estimator learns");
  reference->add_option("--out", options->stage.out, "the EXR file to write")->required();
  return {reference, [options] { return run_reference(*options); }};
}

LabCommand add_estimators_command(CLI::App& app) {
  return {app.add_subcommand("estimators", "lists the estimators"), [] {
            for (const auto& e : render::techniques())
              fmt::print("{:10} {}{}\n", e.name, e.unbiased() ? "" : "(biased) ", e.description);
            return 0;
          }};
}

}  // namespace fb::host
