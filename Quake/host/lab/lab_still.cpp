// fullbright-lab still: one picture of so many samples.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "base/system.h"
#include "base/progress.h"
#include "host/lab/lab_numbers.h"
#include "host/lab/lab_stage.h"
#include "lab/bench/bench_view.h"
#include "lab/image_io.h"
#include "lab/iterate/still_job.h"

namespace fb::host {
namespace {

struct StillOptions {
  StageOptions stage;
  std::uint32_t samples = 16, frame = 0;
  bool guided = false, decorrelated = false;
  std::string resume;
};

Status check_still(const StillOptions& o, bool estimator_given) {
  if (!o.stage.out.ends_with(".png") && !o.stage.out.ends_with(".exr"))
    return Error{fmt::format("--out {}: a picture is a .png or an .exr file", o.stage.out)};
  if (o.guided && estimator_given) return Error{"--guided: its estimator is mir; leave --estimator out"};
  if (o.guided) return ok_status();
  if (o.decorrelated) return Error{"--decorrelated: it is a form of --guided"};
  if (!o.resume.empty())
    return Error{"--resume: it keeps the iterations of --guided; `reference` goes on with plain samples"};
  const render::TechniqueInfo* technique = render::find_technique(o.stage.estimator);
  if (technique != nullptr && technique->ends_iterations)
    return Error{fmt::format("--estimator {}: it learns in iterations; use --guided", o.stage.estimator)};
  return ok_status();
}

Status write_still(const std::string& out, const render::Renderer& renderer, const lab::Picture& picture) {
  if (out.ends_with(".png")) {
    const uvec2 size = renderer.output_size();
    return lab::write_png(out, size.x, size.y, renderer.read().output());
  }
  lab::ExrImage exr(picture.width, picture.height);
  exr.add_colors("", picture.pixels);
  return lab::write_exr(out, exr);
}

int run_still(const StillOptions& o, bool estimator_given) {
  if (auto status = check_still(o, estimator_given); !status) return fail(status.error());
  StageOptions options = o.stage;
  if (o.guided) options.estimator = "mir";
  Stage stage;
  if (auto status = open_stage(stage, options); !status) return fail(status.error());
  const auto view = lab::collect_view(*stage.source, {o.frame, o.frame, 0, true, options.fps});
  if (!view) return fail(view.error());
  lab::StillJob job{stage.settings, stage.size, o.samples, o.guided, o.resume};
  if (o.decorrelated) job.settings.mir_decorrelated = 1;
  stage.renderer->resize(stage.size.x, stage.size.y);
  const auto say = [&](const std::string& line) {
    if (options.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  say(lab::still_text(job));
  // Says how many pixels are rendered, too.
  if (auto status = stage.renderer->fit(job.settings); !status) return fail(status.error());
  if (o.guided) {
    const render::IterationMemory memory =
        render::memory_of_iterations(job.settings, stage.renderer->render_size(), lab::schedule_of(job));
    say(lab::memory_text(memory));
    const lab::MemoryLimits limits{physical_memory(), stage.device->limits().local_memory_bytes,
                                   stage.device->is_software()};
    if (auto status = lab::memory_suffices(job, memory, limits); !status) return fail(status.error());
  }

  Progress progress("sample", o.samples, {.quiet = options.quiet});
  std::uint32_t tells = o.guided ? lab::schedule_of(job).front() : 1;  // after this sample
  lab::StillTold told;
  told.resumed = [&](std::uint32_t samples) {
    tells = samples + 1;
    say(fmt::format("{}: goes on after {} samples", o.resume, samples));
  };
  told.sample = [&](std::uint32_t samples, double seconds) {
    const std::uint32_t left = o.samples - samples;
    if (samples == tells && left > 0)
      say(fmt::format("{:.3g} s a sample: about {:.3g} s for the {} that are left", seconds, seconds * left, left));
    progress.update(samples);
  };
  const auto result = lab::render_still(*stage.renderer, job, view->at(0, 0), told);
  if (!result) return fail(result.error());
  if (auto status = write_still(options.out, *stage.renderer, result->picture); !status) return fail(status.error());
  std::error_code ignored;
  if (!o.resume.empty()) std::filesystem::remove(o.resume, ignored);  // the picture is there
  say(fmt::format("{}: {:.3g} s{}{}", options.out, result->wall_ms / 1000, result->report.empty() ? "" : "; ",
                  result->report));
  return finish(stage);
}

}  // namespace

LabCommand add_still_command(CLI::App& app) {
  auto o = std::make_shared<StillOptions>();
  o->stage.estimator = "mcpg_nee";
  CLI::App* still = app.add_subcommand(
      "still",
      "makes one picture of so many samples: plain, or guided by what its first samples teach (multiple importance "
      "reweighting); it says before which it takes, and how much memory and time");
  add_stage_options(*still, o->stage);
  still->remove_option(still->get_option("--spp"));
  still->remove_option(still->get_option("--timing"));
  add_number(*still, "--samples", o->samples, 1u, lab::kMostScheduled, "samples per pixel");
  add_number(*still, "--frame", o->frame, 0u, kMostFrames, "number of the frame, from 0");
  still->add_flag("--guided", o->guided,
                  "in iterations of 2, 2, 2, 2, 4, 8, ... samples, of which each is guided by those before; biased");
  still->add_flag("--decorrelated", o->decorrelated,
                  "of --guided: half of each iteration's samples teaches and is not seen; unbiased");
  still->add_option("--resume", o->resume,
                    "of --guided: file in which the state is kept after each iteration; with the same command a "
                    "picture that was interrupted goes on from it; removed when the picture is written");
  still->add_option("--out", o->stage.out, "the .png (as a screen shows it) or .exr (linear radiance) file to write")
      ->required();
  return {still, [o, still] { return run_still(*o, still->count("--estimator") > 0); }};
}

}  // namespace fb::host
