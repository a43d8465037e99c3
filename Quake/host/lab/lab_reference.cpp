// fullbright-lab reference, reference-merge: one frame with many samples, made block by block.
#include <fmt/format.h>

#include "host/build_text.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "host/options.h"
#include "lab/reference/reference_job.h"
#include "render/techniques/technique.h"

namespace fb::host {
namespace {

struct ReferenceOptions {
  StageOptions stage;
  std::uint64_t frame = 0;
  std::uint32_t warmup = 0;
  double relative_error = 0, seconds = 0;
  std::string blocks, shard;
};

int run_reference(const ReferenceOptions& options, bool samples_given) {
  const StageOptions& o = options.stage;
  if (!o.out.ends_with(".exr")) return fail(Error{fmt::format("--out {}: a reference is an .exr file", o.out)});
  const auto shard = parse_shard(options.shard);
  if (!shard) return fail(shard.error());
  const bool until = options.relative_error > 0 || options.seconds > 0;
  if (shard->count > 1 && until)
    return fail(Error{"--shard: parts are of so many samples (--spp), not of an error or a time"});
  if (auto status = unbiased_estimator(o.estimator, "--estimator"); !status) return fail(status.error());
  const render::TechniqueInfo* technique = render::find_technique(o.estimator);
  if (options.warmup > 0 && technique->frames == render::Frames::kCorrelated)
    return fail(Error{fmt::format(
        "--warmup: {} shares samples between frames, so that each part of a block begins with nothing: leave it out",
        o.estimator)});
  Stage stage;
  if (auto status = open_stage(stage, o); !status) return fail(status.error());
  lab::ReferenceJob job;
  job.frame = options.frame;
  job.width = stage.size.x;
  job.height = stage.size.y;
  job.spp = until && !samples_given ? kMostSamples : o.spp;
  job.relative_error = options.relative_error;
  job.seconds = options.seconds;
  job.warmup = options.warmup;
  job.shard = shard->index;
  job.shards = shard->count;
  job.out = o.out;
  const bool several = lab::plan_blocks(job.spp).size() > 1 || shard->count > 1;
  job.blocks = !options.blocks.empty() ? options.blocks : several ? o.out + ".blocks" : "";
  job.view = view_text(o) + fmt::format(" --frame {}", options.frame);
  job.program = version_text() + ", " + build_text();
  job.quiet = o.quiet;
  const auto summary = lab::render_reference(*stage.source, *stage.renderer, stage.settings, job);
  if (!summary) return fail(summary.error());
  const std::string what = shard->count > 1 ? fmt::format("{}, shard {}", summary->folder, options.shard) : o.out;
  fmt::print("{}: mean luminance {:.6g}, pixels' standard error {:.3g} of it, {} samples, {} of them rendered now\n",
             what, summary->error.mean_luminance, summary->error.relative, summary->samples, summary->made);
  if (!job.blocks.empty() && !o.quiet)
    fmt::print(
        "its blocks are in {}: a run with more samples goes on from them; without such a run, delete the folder\n",
        summary->folder);
  if (options.relative_error > 0 && summary->error.relative > options.relative_error)
    return fail(Error{fmt::format("{}: the error is {:.3g}, not {:.3g}: more samples{} are needed", o.out,
                                  summary->error.relative, options.relative_error,
                                  options.seconds > 0 ? " or more time" : "")});
  return finish(stage);
}

}  // namespace

LabCommand add_reference_command(CLI::App& app) {
  auto options = std::make_shared<ReferenceOptions>();
  CLI::App* reference = app.add_subcommand(
      "reference",
      "averages many samples of one frame, so many, to an error or for a time, and writes mean and variance to an EXR "
      "file; started again it goes on where it ended");
  add_stage_options(*reference, options->stage);
  add_number(*reference, "--frame", options->frame, std::uint64_t{0}, std::uint64_t{kMostFrames},
             "number of the frame, from 0");
  // Their defaults, 0, are for none: nothing reaches an error of 0.
  add_number(*reference, "--error", options->relative_error, 1e-6, 10.0,
             "end at this standard error of a pixel's luminance, relative to the mean luminance, --spp at most")
      ->default_str("");
  add_number(*reference, "--time", options->seconds, 0.001, 1e7, "end after so many seconds, --spp at most")
      ->default_str("");
  add_number(*reference, "--warmup", options->warmup, 0u, kMostSamples,
             "samples per pixel discarded at the start of each block, from which an estimator learns");
  reference->add_option("--blocks", options->blocks,
                        "folder in which blocks of samples are kept (default: OUT.blocks)");
  reference->add_option("--shard", options->shard,
                        "I/N: only every N-th block from the I-th on, and no picture: reference-merge joins them");
  reference->add_option("--out", options->stage.out, "the EXR file to write")->required();
  return {reference, [options, reference] { return run_reference(*options, reference->count("--spp") > 0); }};
}

LabCommand add_reference_merge_command(CLI::App& app) {
  return add_merge_command(app, "reference-merge", "joins the blocks that the shards of a reference have made",
                           "the shards' folders of blocks (OUT.blocks)", "the EXR file to write",
                           [](const std::vector<std::string>& folders, const std::string& out) {
                             const auto summary = lab::merge_references(folders, out);
                             if (!summary) return fail(summary.error());
                             fmt::print("{}: mean luminance {:.6g}, pixels' standard error {:.3g} of it, {} samples\n",
                                        out, summary->error.mean_luminance, summary->error.relative, summary->samples);
                             return 0;
                           });
}

}  // namespace fb::host
