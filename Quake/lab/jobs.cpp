#include "lab/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/hash.h"
#include "lab/image_io.h"
#include "lab/picture.h"
#include "base/progress.h"
#include "shared/packing.h"

namespace fb::lab {
namespace {

// Work is cut into dispatches of so many samples a pixel, so that progress shows and no device's watchdog bites.

// The frame that ends the run early names how far the source went.
Result<bool> step(FrameSource& source, scene::FrameSnapshot& snapshot, std::uint64_t frame) {
  auto more = source.next(snapshot);
  if (more && !*more)
    return Error{fmt::format("there is no frame {}: the demo has {} frames at this rate", frame, frame)};
  return more;
}

void add_times(RenderSummary& summary, const std::vector<render::PassTime>& times, bool new_frame) {
  // A pass that a frame does not have took no time there.
  const std::size_t frames =
      summary.passes.empty() ? 1 : summary.passes.front().milliseconds.size() + (new_frame ? 1 : 0);
  for (RenderSummary::Pass& pass : summary.passes) pass.milliseconds.resize(frames, 0.0);
  for (const render::PassTime& pass : times) {
    auto same =
        std::find_if(summary.passes.begin(), summary.passes.end(), [&](const auto& p) { return p.name == pass.name; });
    if (same == summary.passes.end())
      same = summary.passes.insert(same, {pass.name, std::vector<double>(frames, 0.0), pass.kind});
    same->milliseconds.back() += pass.milliseconds;
  }
}

Status write_frame(const render::Renderer& renderer, const RenderJob& job, std::uint64_t frame) {
  const std::string path = fmt::format("{}/frame_{:06}", job.out, frame);
  if (job.format != ImageFormat::kExr) {
    const uvec2 size = renderer.output_size();
    auto status = write_png(path + ".png", size.x, size.y, renderer.read().output());
    if (!status || job.format == ImageFormat::kPng) return status;
  }
  ExrImage exr(renderer.render_size().x, renderer.render_size().y);
  exr.add_colors("", picture_of(renderer.read().denoised(), renderer.render_size()).pixels);
  return write_exr(path + ".exr", exr);
}

}  // namespace

// All passes have equal weight, so they must have equal samples: the largest divisor of spp that is small enough.
std::uint32_t samples_per_pass(std::uint32_t spp, std::uint32_t most) {
  std::uint32_t per_pass = std::min(spp, most);
  while (spp % per_pass != 0) --per_pass;
  return per_pass;
}

double RenderSummary::Pass::median() const {
  if (milliseconds.empty()) return 0.0;
  std::vector<double> sorted = milliseconds;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  return sorted[sorted.size() / 2];
}

void render_samples(render::Renderer& renderer, render::RenderSettings& settings, const scene::FrameSnapshot& snapshot,
                    std::uint32_t spp, RenderSummary& summary, const std::function<void(std::uint32_t)>& progress,
                    std::uint32_t most_per_pass) {
  renderer.restart_accumulation();
  settings.accumulate = 1;
  std::uint32_t done = 0;
  const std::uint32_t per_pass = samples_per_pass(spp, most_per_pass);
  settings.spp = static_cast<int>(per_pass);
  while (done < spp) {
    renderer.render(snapshot, nullptr, settings);
    done += per_pass;
    add_times(summary, renderer.pass_times(), done == per_pass);
    if (progress) progress(done);
  }
}

Result<RenderSummary> render_frames(FrameSource& source, render::Renderer& renderer, render::RenderSettings settings,
                                    const RenderJob& job) {
  if (job.last < job.first)
    return Error{fmt::format("--frames {}:{}: the last comes before the first", job.first, job.last)};
  const bool writes = !job.out.empty() && job.format != ImageFormat::kNone;
  if (writes) {
    std::error_code failed;
    std::filesystem::create_directories(job.out, failed);
    if (failed) return Error{fmt::format("--out {}: {}", job.out, failed.message())};
  }
  renderer.resize(job.width, job.height);
  RenderSummary summary;
  scene::FrameSnapshot snapshot;
  Progress progress("frame", job.last - job.first + 1, {.quiet = job.quiet});
  for (std::uint64_t frame = 0; frame <= job.last; ++frame) {
    if (auto more = step(source, snapshot, frame); !more) return more.error();
    if (frame + job.warmup < job.first) continue;
    RenderSummary of_warmup;
    render_samples(renderer, settings, snapshot, job.spp, frame < job.first ? of_warmup : summary, nullptr);
    if (frame < job.first) continue;
    const std::vector<vec4> linear = renderer.read().linear();
    if (job.hash) {
      fmt::print("frame {} hash {:016x}\n", frame, hash_span(std::span<const vec4>(linear)));
      std::fflush(stdout);
    }
    if (writes) {
      if (auto status = write_frame(renderer, job, frame); !status) return status.error();
    }
    progress.update(++summary.frames);
  }
  return summary;
}

}  // namespace fb::lab
