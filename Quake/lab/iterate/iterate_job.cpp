#include "lab/iterate/iterate_job.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <ratio>
#include <utility>

#include "base/progress.h"
#include "lab/reference/replicates.h"

namespace fb::lab {
namespace {

// A configuration at work.
struct IterateLane {
  render::RenderSettings settings;
  std::unique_ptr<render::Renderer> renderer;
  IteratedConfiguration result;
  Runs pictures;
  std::vector<double> gpu_ms, estimator_ms, wall_ms;
};

Result<IterateLane> open_lane(gpu::Device& device, const Configuration& configuration, const View& view,
                              const Reference& reference, const IterateJob& job) {
  if (configuration.settings.spp != 1)
    return Error{fmt::format("{}: r_spp {}: the schedule says how many samples there are, and r_spp is 1",
                             configuration.name, configuration.settings.spp)};
  IterateLane lane;
  lane.settings = configuration.settings;
  auto renderer = render::Renderer::create(device, lane.settings);
  if (!renderer) return renderer.error();
  lane.renderer = std::move(*renderer);
  lane.renderer->resize(job.width, job.height);
  render_iterations(*lane.renderer, lane.settings, view.at(0, 0), {1}, nullptr);  // compiles, uploads
  if (auto status = check_size(reference, lane.renderer->render_size(), configuration.name); !status)
    return status.error();
  lane.result.name = configuration.name;
  lane.result.estimator = configuration.settings.estimator;
  lane.result.runs = {job.runs, 0, 1, samples_of(job.schedule), {}};
  return lane;
}

void add_run(IterateLane& lane, IteratedPicture run, const Reference& reference, const MetricOptions& metrics) {
  FrameRecord record;
  record.gpu_ms = run.gpu_ms;
  record.estimator_ms = run.estimator_ms;
  record.measured = true;
  record.errors = measure(reference, run.picture, metrics);
  lane.result.runs.records.push_back(record);
  lane.gpu_ms.push_back(run.gpu_ms);
  lane.estimator_ms.push_back(run.estimator_ms);
  lane.wall_ms.push_back(run.wall_ms);
  lane.pictures.add(run.picture);
  if (lane.pictures.count() > 1) return;
  lane.result.first = std::move(run.picture);
  lane.result.report = std::move(run.report);
}

void summarise(IterateLane& lane, const Reference& reference, const Frames* baseline) {
  IteratedConfiguration& r = lane.result;
  r.statistics = window_statistics(r.runs, {}, baseline);
  r.gpu_ms = factor_over_runs(lane.gpu_ms, kFewestSteadyRuns);
  r.estimator_ms = factor_over_runs(lane.estimator_ms, kFewestSteadyRuns);
  r.wall_ms = factor_over_runs(lane.wall_ms, kFewestSteadyRuns);
  r.variance = lane.pictures.variance();
  r.bias_squared = lane.pictures.bias_squared(reference);
  r.not_finite = lane.renderer->read().counters().not_finite;
}

}  // namespace

IteratedPicture render_iterations(render::Renderer& renderer, render::RenderSettings settings,
                                  scene::FrameSnapshot snapshot, const Schedule& schedule,
                                  const std::function<void(std::uint32_t)>& progress, const IterationBreaks* breaks) {
  const auto start = std::chrono::steady_clock::now();
  settings = settings_of_samples(std::move(settings));
  snapshot.frame = 0;  // frames differ by how many are accumulated
  snapshot.cut = true;
  const std::uint32_t first = breaks != nullptr ? breaks->first : 0;
  if (first == 0) {
    renderer.reset_learning();
    renderer.restart_accumulation();
  }
  IteratedPicture result;
  for (std::uint32_t i = 0; i < first; ++i) result.samples += schedule[i];
  const auto frame = [&] {
    renderer.render(snapshot, nullptr, settings);
    snapshot.cut = false;
    for (const render::PassTime& pass : renderer.pass_times()) {
      result.gpu_ms += pass.milliseconds;
      if (pass.kind == render::PassKind::kEstimator) result.estimator_ms += pass.milliseconds;
    }
  };
  for (std::uint32_t i = first; i < schedule.size(); ++i) {
    renderer.begin_iteration(i, schedule[i]);
    for (std::uint32_t k = 0; k < schedule[i]; ++k) {
      frame();
      ++result.samples;
      if (progress) progress(result.samples);
    }
    if (breaks != nullptr && i + 1 < schedule.size() && !breaks->ended(i + 1, result.samples)) return result;
  }
  const render::TechniqueInfo* technique = render::find_technique(settings.estimator);
  if (technique != nullptr && technique->ends_iterations) {
    renderer.end_iterations();
    frame();
  }
  result.report = renderer.iterations_report();
  result.wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  result.picture = picture_of(renderer.read().linear(), renderer.render_size());
  return result;
}

Result<IterateResult> run_iterate(gpu::Device& device, const View& view, const Reference& reference,
                                  const IterateJob& job) {
  std::vector<IterateLane> lanes;
  for (const Configuration& configuration : job.configurations) {
    auto lane = open_lane(device, configuration, view, reference, job);
    if (!lane) return lane.error();
    lanes.push_back(std::move(*lane));
  }
  const std::uint64_t samples = samples_of(job.schedule);
  std::uint64_t done = 0;
  Progress progress("sample", samples * job.runs * lanes.size(), {.quiet = job.quiet});
  for (std::uint32_t run = 0; run < job.runs; ++run) {
    for (std::size_t k = 0; k < lanes.size(); ++k) {
      const std::size_t i = (k + run) % lanes.size();
      lanes[i].settings.seed = job.configurations[i].settings.seed + 1 + static_cast<int>(run);
      add_run(lanes[i],
              render_iterations(*lanes[i].renderer, lanes[i].settings, view.at(0, 0), job.schedule,
                                [&](std::uint32_t now) { progress.update(done + now); }),
              reference, job.metrics);
      done += samples;
    }
  }
  IterateResult result{job.schedule,
                       job.width,
                       job.height,
                       figures_of({reference}),
                       device.report().name,
                       lanes.front().renderer->intersector_name(),
                       {}};
  for (IterateLane& lane : lanes)
    summarise(lane, reference, &lane == &lanes.front() ? nullptr : &lanes.front().result.runs);
  for (IterateLane& lane : lanes) result.configurations.push_back(std::move(lane.result));
  return result;
}

}  // namespace fb::lab
