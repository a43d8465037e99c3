#include "lab/bench/bench_job.h"

#include <limits>
#include <map>
#include <memory>

#include "base/progress.h"

namespace fb::lab {
namespace {

// A configuration at work.
struct BenchLane {
  render::RenderSettings settings;
  std::unique_ptr<render::Renderer> renderer;
  ConfigurationResult result;
  std::map<std::string, std::vector<double>> passes;  // of measured frames
  std::vector<std::string> pass_order;
  std::map<std::string, render::PassKind> pass_kinds;
  Runs run_average, warm_average;  // of this run
  Runs frames;                     // of the last window, all runs
};

Result<BenchLane> open_lane(gpu::Device& device, const Configuration& configuration, const View& view,
                            const BenchJob& job) {
  BenchLane lane;
  lane.settings = configuration.settings;
  lane.settings.accumulate = 0;
  auto renderer = render::Renderer::create(device, lane.settings);
  if (!renderer) return renderer.error();
  lane.renderer = std::move(*renderer);
  lane.renderer->resize(job.width, job.height);
  lane.renderer->render(view.at(0, 0), nullptr, lane.settings);  // compiles, uploads
  lane.result.name = configuration.name;
  lane.result.estimator = configuration.settings.estimator;
  lane.result.frames.runs = job.runs;
  lane.result.frames.warmup = view.warmup;
  lane.result.frames.measured = view.measured;
  lane.result.frames.spp = static_cast<std::uint32_t>(configuration.settings.spp);
  return lane;
}

void add_times(BenchLane& lane, FrameRecord& record, bool measured) {
  for (const render::PassTime& pass : lane.renderer->pass_times()) {
    record.gpu_ms += pass.milliseconds;
    if (pass.kind == render::PassKind::kEstimator) record.estimator_ms += pass.milliseconds;
  }
  if (!measured) return;
  std::map<std::string, double> sums;  // a name may come twice in a frame
  for (const render::PassTime& pass : lane.renderer->pass_times()) {
    if (!lane.passes.contains(pass.name)) lane.pass_order.push_back(pass.name);
    lane.passes.try_emplace(pass.name);
    lane.pass_kinds[pass.name] = pass.kind;
    sums[pass.name] += pass.milliseconds;
  }
  for (const auto& [name, milliseconds] : sums) lane.passes[name].push_back(milliseconds);
}

void add_running_errors(BenchLane& lane, FrameRecord& record, const Picture& picture, const Reference& reference,
                        bool warm, const MetricOptions& metrics) {
  lane.run_average.add(picture);
  const Errors running = measure(reference, lane.run_average.mean(), metrics);
  record.running_mse = running.mse_corrected();
  record.running_rel_mse = running.rel_mse_corrected();
  if (!warm) return;
  lane.warm_average.add(picture);
  const Errors warm_running = measure(reference, lane.warm_average.mean(), metrics);
  record.warm_running_mse = warm_running.mse_corrected();
  record.warm_running_rel_mse = warm_running.rel_mse_corrected();
  lane.frames.add(picture);
}

FrameRecord render_frame(BenchLane& lane, const View& view, std::uint32_t run, std::uint32_t index,
                         const std::vector<Reference>& references, const BenchJob& job) {
  lane.renderer->render(view.at(run, index), nullptr, lane.settings);
  const bool warm = index >= view.warmup;
  FrameRecord record;
  record.measured = view.still || warm;
  add_times(lane, record, warm);
  if (!record.measured) return record;
  const Picture picture = picture_of(lane.renderer->read().denoised(), lane.renderer->render_size());
  const Reference& reference = references[view.still ? 0 : index - view.warmup];
  record.errors = measure(reference, picture, job.metrics);
  if (view.still)
    add_running_errors(lane, record, picture, reference, warm, job.metrics);
  else
    lane.result.picture = picture;
  return record;
}

ConfigurationResult::Pass pass_times(std::string name, const std::vector<double>& milliseconds) {
  return {std::move(name), quantile(milliseconds, 0.5), quantile(milliseconds, 0.1), quantile(milliseconds, 0.9)};
}

void summarise(BenchLane& lane, const View& view, const std::vector<Reference>& references, const Frames* baseline) {
  ConfigurationResult& r = lane.result;
  std::vector<double> all, own;
  for (std::uint32_t run = 0; run < r.frames.runs; ++run) {
    for (std::uint32_t i = view.warmup; i < view.frames(); ++i) {
      all.push_back(r.frames.at(run, i).gpu_ms);
      own.push_back(r.frames.at(run, i).estimator_ms);
    }
  }
  r.all = pass_times("all", all);
  r.estimator_passes = pass_times("estimator", own);
  for (const std::string& name : lane.pass_order) {
    r.passes.push_back(pass_times(name, lane.passes[name]));
    r.passes.back().kind = lane.pass_kinds[name];
  }
  r.not_finite = lane.renderer->read().counters().not_finite;
  if (view.still || view.warmup == 0) r.windows.push_back(window_statistics(r.frames, {false, 0}, baseline));
  if (view.warmup > 0) r.windows.push_back(window_statistics(r.frames, {true, view.warmup}, baseline));
  if (view.still) {
    r.picture = lane.frames.mean();
    r.variance = lane.frames.variance();
    const render::TechniqueInfo* technique = render::find_technique(r.estimator);
    const bool correlated = technique != nullptr && technique->frames == render::Frames::kCorrelated;
    r.bias_squared = correlated ? std::numeric_limits<double>::quiet_NaN() : lane.frames.bias_squared(references[0]);
  }
}

}  // namespace

Result<BenchResult> run_bench(gpu::Device& device, const View& view, const std::vector<Reference>& references,
                              const BenchJob& job) {
  std::vector<BenchLane> lanes;
  for (const Configuration& configuration : job.configurations) {
    auto lane = open_lane(device, configuration, view, job);
    if (!lane) return lane.error();
    lanes.push_back(std::move(*lane));
  }
  for (const BenchLane& lane : lanes)
    for (const Reference& reference : references)
      if (auto status = check_size(reference, lane.renderer->render_size(), lane.result.name); !status)
        return status.error();

  Progress progress("frame", std::uint64_t{job.runs} * view.frames(), {.quiet = job.quiet});
  for (std::uint32_t run = 0; run < job.runs; ++run) {
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      BenchLane& lane = lanes[i];
      lane.renderer->reset_learning();
      lane.settings.seed = job.configurations[i].settings.seed + 1 + static_cast<int>(run);
      lane.run_average = lane.warm_average = Runs();
    }
    for (std::uint32_t index = 0; index < view.frames(); ++index) {
      for (std::size_t k = 0; k < lanes.size(); ++k) {
        BenchLane& lane = lanes[(k + index) % lanes.size()];
        lane.result.frames.records.push_back(render_frame(lane, view, run, index, references, job));
      }
      progress.update(std::uint64_t{run} * view.frames() + index + 1);
    }
  }

  BenchResult result;
  result.still = view.still;
  result.first_frame = view.first_frame;
  result.width = job.width;
  result.height = job.height;
  result.device = device.report().name;
  result.intersector = lanes.front().renderer->intersector_name();
  result.reference = figures_of(references);
  for (BenchLane& lane : lanes) {
    summarise(lane, view, references, &lane == &lanes.front() ? nullptr : &lanes.front().result.frames);
  }
  for (BenchLane& lane : lanes) result.configurations.push_back(std::move(lane.result));
  return result;
}

}  // namespace fb::lab
