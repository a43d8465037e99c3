#include "lab/bench/bench_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"

namespace fb::lab {
namespace {

// One figure of every frame of the window, run after run.
template <typename Figure>
std::vector<double> column(const Frames& frames, const Window& window, const Figure& figure) {
  std::vector<double> values;
  values.reserve(std::size_t{frames.runs} * frames.measured);
  for (std::uint32_t run = 0; run < frames.runs; ++run)
    for (std::uint32_t i = 0; i < frames.measured; ++i) values.push_back(figure(frames.at(run, window.first + i)));
  return values;
}

struct Columns {
  std::vector<double> mse, rel_mse, gpu_ms, estimator_ms;
};
Columns columns(const Frames& frames, const Window& window) {
  return {column(frames, window, [](const FrameRecord& f) { return f.errors.mse_corrected(); }),
          column(frames, window, [](const FrameRecord& f) { return f.errors.rel_mse_corrected(); }),
          column(frames, window, [](const FrameRecord& f) { return f.gpu_ms; }),
          column(frames, window, [](const FrameRecord& f) { return f.estimator_ms; })};
}

// A figure of each run: of its frames' values, which stand run after run.
template <typename Figure>
std::vector<double> of_runs(const std::vector<double>& frames, std::uint32_t runs, const Figure& figure) {
  std::vector<double> values;
  const std::size_t length = frames.size() / std::max(runs, 1u);
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto first = frames.begin() + static_cast<std::ptrdiff_t>(run * length);
    values.push_back(figure(std::vector<double>(first, first + static_cast<std::ptrdiff_t>(length))));
  }
  return values;
}
double mean_over(const std::vector<double>& values) { return mean(values); }
double median_over(const std::vector<double>& values) { return median(values); }

// Each run's MSE is above zero only where it has more than the reference's noise.
std::vector<double> products(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] *= b[i];
  return a;
}
std::vector<double> ratios(std::vector<double> above, const std::vector<double>& below) {
  for (std::size_t i = 0; i < above.size(); ++i)
    above[i] = above[i] > 0 && below[i] > 0 ? above[i] / below[i] : std::numeric_limits<double>::quiet_NaN();
  return above;
}

// `error`: the column of errors.
Gains gains_against(const Columns& base, std::uint32_t base_spp, const Columns& own, std::uint32_t own_spp,
                    std::uint32_t runs, const std::vector<double> Columns::*error) {
  const auto over_runs = [&](auto figure, const std::vector<double> Columns::*column) {
    return ratios(of_runs(base.*column, runs, figure), of_runs(own.*column, runs, figure));
  };
  const std::vector<double> errors = over_runs(mean_over, error), time = over_runs(median_over, &Columns::estimator_ms);
  const std::vector<double> paired = of_runs(ratios(base.estimator_ms, own.estimator_ms), runs, median_over);
  const double samples = static_cast<double>(base_spp) / own_spp;
  Gains gains;
  gains.samples = factor_over_runs(products(errors, std::vector<double>(errors.size(), samples)));
  const double above = mean(base.*error), below = mean(own.*error);
  gains.samples_of_means = above > 0 && below > 0 ? above / below * samples : std::numeric_limits<double>::quiet_NaN();
  gains.time = factor_over_runs(products(errors, time));
  gains.time_all = factor_over_runs(products(errors, over_runs(median_over, &Columns::gpu_ms)));
  gains.time_paired = factor_over_runs(products(errors, paired));
  gains.typical_time = factor_over_runs(products(over_runs(median_over, error), time));
  return gains;
}

// Of one run alone nothing is known.
double error_over_runs(const std::vector<double>& runs) {
  return runs.size() > 1 ? standard_error(runs) : std::numeric_limits<double>::quiet_NaN();
}

Errored errored(const std::vector<double>& frames, std::uint32_t runs) {
  const std::vector<double> of_run = of_runs(frames, runs, mean_over);
  const Estimate typical = factor_over_runs(of_run);
  return {mean(of_run), error_over_runs(of_run), typical,
          rare_values_rule(frames) || (runs > 1 && mean(of_run) > 1.1 * typical.value)};
}

}  // namespace

WindowStatistics window_statistics(const Frames& frames, const Window& window, const Frames* baseline) {
  FB_CHECK_EQ(frames.records.size(), std::size_t{frames.runs} * (frames.warmup + frames.measured));
  const Columns own = columns(frames, window);
  WindowStatistics s;
  s.window = window;
  s.mse = errored(own.mse, frames.runs);
  s.mse_median = median(own.mse);
  s.rel_mse = errored(own.rel_mse, frames.runs);
  s.rel_mse_median = median(own.rel_mse);
  const auto bias = column(frames, window, [](const FrameRecord& f) { return f.errors.bias; });
  const auto bias_of_reference =
      column(frames, window, [](const FrameRecord& f) { return f.errors.reference_bias_error; });
  s.bias = mean(bias);
  s.bias_error = std::hypot(errored(bias, frames.runs).standard_error, mean(bias_of_reference));
  s.median_pixel = mean(column(frames, window, [](const FrameRecord& f) { return f.errors.median_mse; }));
  s.reference_variance = mean(column(frames, window, [](const FrameRecord& f) { return f.errors.reference_variance; }));
  const double raw = mean(column(frames, window, [](const FrameRecord& f) { return f.errors.mse; }));
  const double top =
      mean(column(frames, window, [](const FrameRecord& f) { return f.errors.mse * f.errors.top_share; }));
  s.top_share = raw > 0 ? top / raw : 0;
  s.gpu_ms = median(own.gpu_ms);
  s.estimator_ms = median(own.estimator_ms);
  if (baseline != nullptr) {
    FB_CHECK(baseline->runs == frames.runs && baseline->warmup == frames.warmup &&
             baseline->measured == frames.measured);
    const Columns base = columns(*baseline, window);
    s.gains = gains_against(base, baseline->spp, own, frames.spp, frames.runs, &Columns::mse);
    s.rel_gains = gains_against(base, baseline->spp, own, frames.spp, frames.runs, &Columns::rel_mse);
  }
  return s;
}

Curve running_curve(const Frames& frames, const Window& window) {
  Curve curve;
  double gpu_ms = 0, estimator_ms = 0;
  for (std::uint32_t i = window.first; i < frames.warmup + frames.measured; ++i) {
    double mse = 0, rel_mse = 0;
    for (std::uint32_t run = 0; run < frames.runs; ++run) {
      const FrameRecord& f = frames.at(run, i);
      mse += (window.warm ? f.warm_running_mse : f.running_mse) / frames.runs;
      rel_mse += (window.warm ? f.warm_running_rel_mse : f.running_rel_mse) / frames.runs;
      gpu_ms += f.gpu_ms / frames.runs;
      estimator_ms += f.estimator_ms / frames.runs;
    }
    curve.mse.push_back(mse);
    curve.rel_mse.push_back(rel_mse);
    curve.gpu_ms.push_back(gpu_ms);
    curve.estimator_ms.push_back(estimator_ms);
  }
  return curve;
}

std::vector<FrameOverRuns> frames_over_runs(const Frames& frames) {
  std::vector<FrameOverRuns> list;
  for (std::uint32_t i = 0; i < frames.warmup + frames.measured; ++i) {
    if (!frames.at(0, i).measured) continue;
    std::vector<double> mse, rel_mse, estimator_ms;
    for (std::uint32_t run = 0; run < frames.runs; ++run) {
      const FrameRecord& f = frames.at(run, i);
      mse.push_back(f.errors.mse_corrected());
      rel_mse.push_back(f.errors.rel_mse_corrected());
      estimator_ms.push_back(f.estimator_ms);
    }
    list.push_back({i, mean(mse), error_over_runs(mse), mean(rel_mse), median(estimator_ms)});
  }
  return list;
}

}  // namespace fb::lab
