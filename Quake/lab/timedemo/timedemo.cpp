#include "lab/timedemo/timedemo.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace fb::lab {
namespace {

// Frames a second over the slowest share of frames, at least one; `slowest` is sorted, the slowest first.
double low(const std::vector<double>& slowest, double share) {
  if (slowest.empty()) return 0;
  const auto count =
      std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(share * static_cast<double>(slowest.size())));
  const double sum = std::accumulate(slowest.begin(), slowest.begin() + count, 0.0);
  return sum > 0 ? 1e3 * static_cast<double>(count) / sum : 0;
}

}  // namespace

void TimedRun::add(const TimedFrame& frame, const std::vector<PassOfFrame>& passes_of_frame) {
  times.push_back(frame);
  for (TimedPass& pass : passes) pass.milliseconds.push_back(0);
  for (const PassOfFrame& added : passes_of_frame) {
    auto same = std::find_if(passes.begin(), passes.end(), [&](const TimedPass& p) { return p.name == added.name; });
    if (same == passes.end())
      same = passes.insert(same, {std::string(added.name), added.of_estimator, std::vector<double>(times.size(), 0.0)});
    same->milliseconds.back() += added.milliseconds;
  }
}

TimedDemo& Timedemos::demo(const std::string& name) {
  const auto same = std::find_if(demos.begin(), demos.end(), [&](const TimedDemo& d) { return d.name == name; });
  return same != demos.end() ? *same : demos.emplace_back(TimedDemo{name, {}, {}});
}

FrameFigures frame_figures(const TimedRun& run) {
  FrameFigures f;
  std::vector<double> whole;
  for (const TimedFrame& frame : run.times) whole.push_back(frame.whole);
  f.mean = mean(whole);
  f.p1 = quantile(whole, 0.01);
  f.p5 = quantile(whole, 0.05);
  f.p50 = quantile(whole, 0.5);
  f.p95 = quantile(whole, 0.95);
  f.p99 = quantile(whole, 0.99);
  f.p999 = quantile(whole, 0.999);
  std::vector<std::size_t> order(whole.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return whole[a] > whole[b]; });
  std::vector<double> slowest;
  for (const std::size_t i : order) slowest.push_back(whole[i]);
  f.low_1 = low(slowest, 0.01);
  f.low_01 = low(slowest, 0.001);
  order.resize(std::min(order.size(), kWorstFrames));
  f.worst = std::move(order);
  return f;
}

Estimate fps_over_runs(const TimedDemo& demo) {
  std::vector<double> rates;
  for (const TimedRun& run : demo.runs) rates.push_back(run.fps());
  return factor_over_runs(rates, kFewestSteadyRuns);
}

std::vector<std::string> timedemo_lines(const Timedemos& timedemos) {
  std::vector<std::string> lines;
  for (const TimedDemo& demo : timedemos.demos) {
    std::vector<double> lows;
    for (const TimedRun& run : demo.runs) lows.push_back(frame_figures(run).low_1);
    const Estimate fps = fps_over_runs(demo);
    std::string line = fmt::format("{}: {} run{}, {:.1f} fps", demo.name, demo.runs.size(),
                                   demo.runs.size() == 1 ? "" : "s", fps.value);
    if (fps.has_interval()) line += fmt::format(" [{:.1f}, {:.1f}]", fps.interval.low, fps.interval.high);
    line += fmt::format(", 1% low {:.1f}", mean(lows));
    if (demo.runs.size() < kFewestSteadyRuns)
      line += "; " + too_few_runs(demo.runs.size(), kFewestSteadyRuns) + ": scr_timedemo_runs";
    lines.push_back(line);
  }
  return lines;
}

}  // namespace fb::lab
