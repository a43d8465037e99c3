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

using Indices = std::span<const std::size_t>;

double mean_at(const std::vector<double>& values, Indices indices) {
  double sum = 0;
  for (const std::size_t i : indices) sum += values[i];
  return sum / static_cast<double>(indices.size());
}
double median_at(const std::vector<double>& values, Indices indices) {
  std::vector<double> chosen;
  chosen.reserve(indices.size());
  for (const std::size_t i : indices) chosen.push_back(values[i]);
  return median(std::move(chosen));
}

Estimate estimate(const Series& series, const Statistic& statistic) {
  std::vector<std::size_t> all(series.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return {statistic(all), bootstrap_interval(series, statistic)};
}

Gains gains_against(const Columns& base, std::uint32_t base_spp, const Columns& own, std::uint32_t own_spp,
                    const Series& series) {
  const double samples = static_cast<double>(base_spp) / own_spp;
  const auto ratio = [](double above, double below) {
    return above > 0 && below > 0 ? above / below : std::numeric_limits<double>::quiet_NaN();
  };
  const auto mse_ratio = [&](Indices i) { return ratio(mean_at(base.mse, i), mean_at(own.mse, i)); };
  const auto time_ratio = [&](Indices i) { return median_at(base.estimator_ms, i) / median_at(own.estimator_ms, i); };
  std::vector<double> paired;
  for (std::size_t i = 0; i < own.estimator_ms.size(); ++i)
    paired.push_back(base.estimator_ms[i] / own.estimator_ms[i]);
  Gains gains;
  gains.samples = estimate(series, [&](Indices i) { return mse_ratio(i) * samples; });
  gains.time = estimate(series, [&](Indices i) { return mse_ratio(i) * time_ratio(i); });
  gains.time_all = estimate(
      series, [&](Indices i) { return mse_ratio(i) * ratio(median_at(base.gpu_ms, i), median_at(own.gpu_ms, i)); });
  gains.time_paired = estimate(series, [&](Indices i) { return mse_ratio(i) * median_at(paired, i); });
  gains.typical_time =
      estimate(series, [&](Indices i) { return ratio(median_at(base.mse, i), median_at(own.mse, i)) * time_ratio(i); });
  return gains;
}

}  // namespace

WindowStatistics window_statistics(const Frames& frames, const Window& window, const Frames* baseline) {
  FB_CHECK_EQ(frames.records.size(), std::size_t{frames.runs} * (frames.warmup + frames.measured));
  const Columns own = columns(frames, window);
  const Series series{frames.runs, frames.measured};
  WindowStatistics s;
  s.window = window;
  s.mse = estimate(series, [&](Indices i) { return mean_at(own.mse, i); });
  s.mse_error = standard_error(own.mse);
  s.mse_median = median(own.mse);
  s.rel_mse = estimate(series, [&](Indices i) { return mean_at(own.rel_mse, i); });
  s.rel_mse_error = standard_error(own.rel_mse);
  s.rel_mse_median = median(own.rel_mse);
  const auto bias = column(frames, window, [](const FrameRecord& f) { return f.errors.bias; });
  const auto bias_of_reference =
      column(frames, window, [](const FrameRecord& f) { return f.errors.reference_bias_error; });
  s.bias = mean(bias);
  s.bias_error = std::hypot(standard_error(bias), mean(bias_of_reference));
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
    s.gains = gains_against(columns(*baseline, window), baseline->spp, own, frames.spp, series);
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
    list.push_back({i, mean(mse), standard_error(mse), mean(rel_mse), median(estimator_ms)});
  }
  return list;
}

}  // namespace fb::lab
