#include "lab/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/hash.h"
#include "lab/image_io.h"
#include "base/progress.h"
#include "shared/packing.h"

namespace fb::lab {
namespace {

// Work is cut into dispatches of so many samples a pixel, so that progress shows and no device's watchdog bites.
constexpr std::uint32_t kSamplesPerPass = 16;

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
    if (same == summary.passes.end()) same = summary.passes.insert(same, {pass.name, std::vector<double>(frames, 0.0)});
    same->milliseconds.back() += pass.milliseconds;
  }
}

std::vector<float> channel(const std::vector<vec4>& image, int component) {
  std::vector<float> values(image.size());
  std::transform(image.begin(), image.end(), values.begin(), [&](const vec4& p) { return p[component]; });
  return values;
}

void add_rgb(ExrImage& exr, const std::vector<vec4>& image, const std::string& prefix) {
  exr.add_channel(prefix + "R", channel(image, 0));
  exr.add_channel(prefix + "G", channel(image, 1));
  exr.add_channel(prefix + "B", channel(image, 2));
}

Status write_frame(const render::Renderer& renderer, const RenderJob& job, std::uint64_t frame) {
  const std::string path = fmt::format("{}/frame_{:06}", job.out, frame);
  if (job.format != ImageFormat::kExr) {
    const uvec2 size = renderer.output_size();
    auto status = write_png(path + ".png", size.x, size.y, renderer.read().output());
    if (!status || job.format == ImageFormat::kPng) return status;
  }
  ExrImage exr(renderer.render_size().x, renderer.render_size().y);
  add_rgb(exr, renderer.read().denoised(), "");
  return write_exr(path + ".exr", exr);
}

// All passes have equal weight, so they must have equal samples: the largest divisor of spp that is small enough.
std::uint32_t samples_per_pass(std::uint32_t spp) {
  std::uint32_t per_pass = std::min(spp, kSamplesPerPass);
  while (spp % per_pass != 0) --per_pass;
  return per_pass;
}

// Shows an estimator that learns what it is to draw. What it has learnt from must not be drawn again: that would bias
// the mean, so these samples are of another seed.
void warm_up(render::Renderer& renderer, render::RenderSettings settings, const scene::FrameSnapshot& snapshot,
             const ReferenceJob& job) {
  settings.seed = ~settings.seed;
  settings.accumulate = 1;
  settings.spp = static_cast<int>(samples_per_pass(job.spp));
  renderer.restart_accumulation();
  Progress progress("sample to learn from", job.warmup, {.quiet = job.quiet});
  for (std::uint32_t done = 0; done < job.warmup; progress.update(std::min(done, job.warmup))) {
    renderer.render(snapshot, nullptr, settings);
    done += static_cast<std::uint32_t>(settings.spp);
  }
}

float luminance(const vec4& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

}  // namespace

double RenderSummary::Pass::median() const {
  if (milliseconds.empty()) return 0.0;
  std::vector<double> sorted = milliseconds;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  return sorted[sorted.size() / 2];
}

void render_samples(render::Renderer& renderer, render::RenderSettings& settings, const scene::FrameSnapshot& snapshot,
                    std::uint32_t spp, RenderSummary& summary, const std::function<void(std::uint32_t)>& progress) {
  renderer.restart_accumulation();
  settings.accumulate = 1;
  std::uint32_t done = 0;
  const std::uint32_t per_pass = samples_per_pass(spp);
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
    if (frame < job.first) continue;
    render_samples(renderer, settings, snapshot, job.spp, summary, nullptr);
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

Result<ReferenceSummary> render_reference(FrameSource& source, render::Renderer& renderer,
                                          render::RenderSettings settings, const ReferenceJob& job) {
  renderer.resize(job.width, job.height);
  scene::FrameSnapshot snapshot;
  for (std::uint64_t frame = 0; frame <= job.frame; ++frame) {
    if (auto more = step(source, snapshot, frame); !more) return more.error();
  }
  RenderSummary timing;
  if (job.warmup > 0) warm_up(renderer, settings, snapshot, job);
  {
    Progress progress("sample", job.spp, {.quiet = job.quiet});
    render_samples(renderer, settings, snapshot, job.spp, timing, [&](std::uint32_t done) { progress.update(done); });
  }
  const std::vector<vec4> mean = renderer.read().linear(), variance = renderer.read().variance_of_mean();
  const auto gbuffer = renderer.read().gbuffer();

  ReferenceSummary summary;
  summary.frames = renderer.accumulated_frames();
  double squared_error = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    summary.mean_luminance += luminance(mean[i]);
    squared_error += luminance(variance[i]);
  }
  const double n = static_cast<double>(mean.size());
  summary.mean_luminance /= n;
  summary.relative_error = summary.mean_luminance > 0 ? std::sqrt(squared_error / n) / summary.mean_luminance : 0;

  ExrImage exr(renderer.render_size().x, renderer.render_size().y);
  add_rgb(exr, mean, "");
  add_rgb(exr, variance, "variance.");
  std::vector<vec4> albedo(gbuffer.size()), normal(gbuffer.size());
  std::vector<float> depth(gbuffer.size());
  for (std::size_t i = 0; i < gbuffer.size(); ++i) {
    albedo[i] = gbuffer[i].albedo_roughness;
    normal[i] = vec4(shared::unpack_direction(gbuffer[i].shading_normal), 0);
    depth[i] = gbuffer[i].motion.z;
  }
  add_rgb(exr, albedo, "albedo.");
  exr.add_channel("normal.X", channel(normal, 0));
  exr.add_channel("normal.Y", channel(normal, 1));
  exr.add_channel("normal.Z", channel(normal, 2));
  exr.add_channel("Z", std::move(depth));
  // What a comparison must do alike: where in a pixel its rays go.
  exr.set_text("fullbright.jitter", settings.jitter != 0 ? "1" : "0");
  exr.set_text("fullbright.spp", fmt::format("{}", job.spp));
  if (auto status = write_exr(job.out, exr); !status) return status.error();
  return summary;
}

}  // namespace fb::lab
