#include "lab/judge/judge_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace fb::lab {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = 1e-12;  // an exact picture's error, so that it has a logarithm

// The mean of logarithms as a factor.
Estimate of_logs(const std::vector<double>& logs, std::size_t fewest) {
  const Estimate e = mean_over_runs(logs, fewest);
  return {std::exp(e.value), {std::exp(e.interval.low), std::exp(e.interval.high)}};
}

double floor_of(JudgeFigure figure, const ReferenceFacts& reference) {
  return figure == kRelMse || figure == kRelMseTrimmed ? std::max(reference.rel_variance, kLeast) : kLeast;
}

double log_of(double value, double least) { return std::log(value > 0 ? value : least); }

// The views of which every lane knows the figure for every seed.
std::vector<const ViewFigures*> complete_views(const std::vector<ViewFigures>& views, JudgeFigure figure) {
  std::vector<const ViewFigures*> complete;
  for (const ViewFigures& view : views) {
    const bool known = std::all_of(view.lanes.begin(), view.lanes.end(), [&](const LaneFigures& lane) {
      return !lane.seeds.empty() && std::all_of(lane.seeds.begin(), lane.seeds.end(),
                                                [&](const Figures& f) { return std::isfinite(f[figure]); });
    });
    if (known) complete.push_back(&view);
  }
  return complete;
}

// A seed's mean over the views of each lane's figure: of its logarithm where it multiplies.
std::vector<double> seed_means(const std::vector<const ViewFigures*>& views, std::size_t lane, JudgeFigure figure) {
  std::size_t seeds = std::numeric_limits<std::size_t>::max();
  for (const ViewFigures* view : views) seeds = std::min(seeds, view->lanes[lane].seeds.size());
  std::vector<double> means(views.empty() ? 0 : seeds, 0.0);
  for (std::size_t s = 0; s < means.size(); ++s) {
    for (const ViewFigures* view : views) {
      const double value = view->lanes[lane].seeds[s][figure];
      means[s] += info(figure).multiplies ? log_of(value, floor_of(figure, view->reference)) : value;
    }
    means[s] /= static_cast<double>(views.size());
  }
  return means;
}

}  // namespace

const FigureInfo& info(JudgeFigure figure) {
  static constexpr std::array<FigureInfo, kFigureCount> rows{{{"flip", true},
                                                              {"flip_silhouettes", true},
                                                              {"relmse", true, kFewestRuns},
                                                              {"relmse_trimmed", true, kFewestRuns},
                                                              {"bias", false},
                                                              {"flicker", true},
                                                              {"lag", false},
                                                              {"isolated_dark", false},
                                                              {"isolated_bright", false},
                                                              {"top_share", false},
                                                              {"gbuffer_ms", true},
                                                              {"paths_ms", true},
                                                              {"denoiser_ms", true},
                                                              {"all_ms", true}}};
  return rows[figure];
}

Figures unknown_figures() {
  Figures figures;
  figures.fill(kUnknown);
  return figures;
}

Figures mean_of(const std::vector<Figures>& frames) {
  Figures means = unknown_figures();
  for (std::size_t f = 0; f < kFigureCount; ++f) {
    double sum = 0;
    std::size_t count = 0;
    for (const Figures& frame : frames) {
      if (!std::isfinite(frame[f])) continue;
      sum += frame[f];
      ++count;
    }
    if (count > 0) means[f] = sum / static_cast<double>(count);
  }
  return means;
}

Estimate over_seeds(const LaneFigures& lane, JudgeFigure figure, double reference_error) {
  std::vector<double> values;
  for (const Figures& seed : lane.seeds) {
    if (!std::isfinite(seed[figure])) return {kUnknown, {kUnknown, kUnknown}};
    values.push_back(seed[figure]);
  }
  const bool positive = std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
  if (info(figure).multiplies && positive) {
    for (double& v : values) v = std::log(v);
    return of_logs(values, info(figure).fewest);
  }
  const auto [center, seeds] = mean_over_runs(values, info(figure).fewest);
  // The reference's error is normal: 1.96 of it are 95%. It is independent of the seeds.
  const double half = std::hypot(0.5 * (seeds.high - seeds.low), 1.96 * reference_error);
  return {center, {center - half, center + half}};
}

Estimate over_views(const std::vector<ViewFigures>& views, std::size_t lane, JudgeFigure figure) {
  const auto complete = complete_views(views, figure);
  if (complete.empty()) return {kUnknown, {kUnknown, kUnknown}};
  const std::vector<double> means = seed_means(complete, lane, figure);
  return info(figure).multiplies ? of_logs(means, info(figure).fewest) : mean_over_runs(means, info(figure).fewest);
}

JudgeGain gain_over_first(const std::vector<ViewFigures>& views, std::size_t lane,
                          const std::vector<std::uint32_t>& spp) {
  const Estimate unknown{kUnknown, {kUnknown, kUnknown}};
  JudgeGain gain{unknown, unknown};
  const auto errors = complete_views(views, kRelMse), times = complete_views(views, kAllMs);
  if (errors.empty()) return gain;
  const auto ratio = [&](const std::vector<const ViewFigures*>& of, JudgeFigure figure) {
    std::vector<double> logs = seed_means(of, 0, figure);
    const std::vector<double> own = seed_means(of, lane, figure);
    for (std::size_t s = 0; s < logs.size(); ++s) logs[s] -= own[s];
    return logs;
  };
  std::vector<double> samples = ratio(errors, kRelMse), time = samples;
  const double cost = std::log(static_cast<double>(spp[0]) / static_cast<double>(spp[lane]));
  for (double& v : samples) v += cost;
  gain.equal_samples = of_logs(samples, kFewestRuns);
  if (times.size() != errors.size()) return gain;
  const std::vector<double> costs = ratio(times, kAllMs);
  for (std::size_t s = 0; s < time.size(); ++s) time[s] += costs[s];
  gain.equal_time = of_logs(time, kFewestRuns);
  return gain;
}

}  // namespace fb::lab
