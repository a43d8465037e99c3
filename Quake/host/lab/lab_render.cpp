// fullbright-lab render, render-merge: chosen frames.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tuple>

#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "host/options.h"
#include "lab/frame_shards.h"
#include "lab/jobs.h"
#include "lab/judge/sequence.h"

namespace fb::host {
namespace {

struct RenderOptions {
  StageOptions stage;
  std::string frames = "0:0", format = "png";
  std::string shard;
  std::uint32_t warmup = 0;
  bool hash = false, denoised = false;
};

// What shards must have in common.
std::string subject_of(const RenderOptions& options) {
  const StageOptions& o = options.stage;
  std::string text = fmt::format("{} {} {} {}, {} at {} fps, {}x{} samples, {}, camera {}, {} {}", version_text(),
                                 o.map, o.demo, o.scene, o.size, o.fps, o.estimator, o.spp, options.format,
                                 o.camera.empty() ? "the player's" : o.camera, options.denoised ? "denoised" : "raw",
                                 fmt::join(o.sets, " "));
  for (const std::string& game : o.games) text += " " + game;
  if (o.lambert) text += ", Lambert";
  return text;
}

int run_render(const RenderOptions& options) {
  StageOptions o = options.stage;
  if (options.denoised) o.sets.insert(o.sets.begin(), "r_denoise=1");
  auto range = parse_frames(options.frames);
  if (!range) return fail(range.error());
  const auto shard = parse_shard(options.shard);
  if (!shard) return fail(shard.error());
  if (shard->count > 1 && o.out.empty()) return fail(Error{"--shard: it needs --out, a folder of its own"});
  const auto own = lab::frames_of_shard(range->first, range->second, shard->index, shard->count);
  if (own.first > own.second)
    return fail(Error{fmt::format("--shard {}: there are fewer frames than shards", options.shard)});
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  lab::RenderJob job;
  std::tie(job.first, job.last) = own;
  job.warmup = options.warmup;
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.spp = o.spp;
  job.out = o.out;
  job.format = options.format == "exr"    ? lab::ImageFormat::kExr
               : options.format == "both" ? lab::ImageFormat::kBoth
                                          : lab::ImageFormat::kPng;
  job.hash = options.hash;
  job.quiet = o.quiet;
  if (shard->count > 1) lab::begin_shard(o.out);
  const auto summary = lab::render_frames(*stage.source, *stage.renderer, stage.settings, job);
  if (!summary) return fail(summary.error());
  if (shard->count > 1) {
    const auto told =
        lab::tell_shard(o.out, {subject_of(options), range->first, range->second, shard->index, shard->count});
    if (!told) return fail(told.error());
  }
  if (o.timing) {
    double total = 0;
    for (const auto& pass : summary->passes) {
      total += pass.median();
      const double first = pass.milliseconds.front();  // compiles on lavapipe
      fmt::print("{:12} {:9.3f} ms a frame, first {:.{}f}{}\n", pass.name, pass.median(), first, first < 10 ? 2 : 0,
                 pass.kind == render::PassKind::kEstimator ? lab::kEstimatorsPass : "");
    }
    fmt::print("{:12} {:9.3f} ms a frame (sum of the passes' medians)\n", "all", total);
  }
  if (!o.out.empty() && !o.quiet) fmt::print("{} frames in {}\n", summary->frames, o.out);
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
  add_number(*render, "--warmup", options->warmup, 0u, kMostFrames,
             "frames before FIRST that are rendered and not written, for an estimator and a denoiser to learn from");
  render->add_option("--shard", options->shard,
                     "I/N: only the I-th of N parts of the frames, into a folder of its own: render-merge joins them");
  render->add_flag("--hash", options->hash, "print a hash of each frame's linear image");
  return {render, [options] { return run_render(*options); }};
}

LabCommand add_render_merge_command(CLI::App& app) {
  return add_merge_command(app, "render-merge", "joins the frames that the shards of a render have written",
                           "the shards' folders", "folder for the frames; it must not be there",
                           [](const std::vector<std::string>& folders, const std::string& out) {
                             const auto frames = lab::merge_frames(folders, out);
                             if (!frames) return fail(frames.error());
                             fmt::print("{} frames in {}\n", *frames, out);
                             return 0;
                           });
}

LabCommand add_estimators_command(CLI::App& app) {
  return {app.add_subcommand("estimators", "lists the estimators"), [] {
            for (const auto& e : render::techniques())
              fmt::print("{:10} {}{}\n", e.name, e.unbiased() ? "" : "(biased) ", e.description);
            return 0;
          }};
}

}  // namespace fb::host
