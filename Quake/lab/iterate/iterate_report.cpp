#include "lab/iterate/iterate_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "lab/json.h"

namespace fb::lab {
namespace {

void add_gains(std::string& out, const IteratedConfiguration& c, const std::string& baseline) {
  const Gains &mse = *c.statistics.gains, &rel_mse = *c.statistics.rel_gains;
  out += fmt::format("  gain of {} over {}{}\n", c.name, baseline, mse.samples.has_interval() ? " [95%]" : "");
  out += gain_line("MSE, equal samples", mse.samples);
  out += gain_line("MSE, equal time of the estimator", mse.time);
  out += gain_line("MSE, equal time of all passes", mse.time_all);
  out += gain_line("relMSE, equal samples", rel_mse.samples);
  out += gain_line("relMSE, equal time of the estimator", rel_mse.time);
  out += gain_line("relMSE, equal time of all passes", rel_mse.time_all);
}

std::string interval_text(const Estimate& e) {
  return e.has_interval() ? fmt::format("[{:.4g}, {:.4g}]", e.interval.low, e.interval.high) : "";
}

Json gains_of(const Gains& gains) {
  return {{"equal_samples", json_of(gains.samples)},
          {"equal_samples_of_means", json_of(gains.samples_of_means)},
          {"equal_time", json_of(gains.time)},
          {"equal_time_all_passes", json_of(gains.time_all)}};
}

Json configuration_of(const IteratedConfiguration& c) {
  const WindowStatistics& s = c.statistics;
  Json json{{"name", c.name},
            {"estimator", c.estimator},
            {"mse_mean", s.mse.mean},
            {"mse_standard_error", json_of(s.mse.standard_error)},
            {"mse_of_a_run", json_of(s.mse.typical)},
            {"mse_heavy_tail", s.mse.heavy_tail},
            {"relmse_mean", s.rel_mse.mean},
            {"relmse_standard_error", json_of(s.rel_mse.standard_error)},
            {"relmse_of_a_run", json_of(s.rel_mse.typical)},
            {"mse_median_pixel", s.median_pixel},
            {"top_share", s.top_share},
            {"bias", s.bias},
            {"bias_standard_error", json_of(s.bias_error)},
            {"variance", c.variance},
            {"bias_squared", c.bias_squared},
            {"gpu_ms", json_of(c.gpu_ms)},
            {"estimator_gpu_ms", json_of(c.estimator_ms)},
            {"wall_ms", json_of(c.wall_ms)},
            {"report", c.report},
            {"samples_not_finite", c.not_finite}};
  Json runs{{"mse", Json::array()},
            {"relmse", Json::array()},
            {"gpu_ms", Json::array()},
            {"estimator_gpu_ms", Json::array()}};
  for (const FrameRecord& run : c.runs.records) {
    runs["mse"].push_back(run.errors.mse_corrected());
    runs["relmse"].push_back(run.errors.rel_mse_corrected());
    runs["gpu_ms"].push_back(run.gpu_ms);
    runs["estimator_gpu_ms"].push_back(run.estimator_ms);
  }
  json["runs"] = std::move(runs);
  if (s.gains) json["gain"] = gains_of(*s.gains);
  if (s.rel_gains) json["gain_relmse"] = gains_of(*s.rel_gains);
  return json;
}

}  // namespace

std::string iterate_table(const IterateResult& result, const BenchTitle& title) {
  const IteratedConfiguration& first = result.configurations.front();
  std::string out = fmt::format("{}, {}x{}; iterations of {} samples a pixel, {} together; {} runs\n{}, {}\n",
                                title.view, result.width, result.height, schedule_text(result.schedule),
                                samples_of(result.schedule), first.runs.runs, result.device, result.intersector);
  out += reference_line(title, result.reference);
  std::size_t width = 13;
  for (const auto& c : result.configurations) width = std::max(width, c.name.size());
  out += "\ntime of a run, ms: of the GPU's passes, and by the clock:\n";
  for (const auto& c : result.configurations) {
    out += fmt::format("  {:{}} all {:.1f} {}; estimator {:.1f} {}; clock {:.1f} {}\n", c.name, width, c.gpu_ms.value,
                       interval_text(c.gpu_ms), c.estimator_ms.value, interval_text(c.estimator_ms), c.wall_ms.value,
                       interval_text(c.wall_ms));
    if (!c.report.empty()) out += fmt::format("  {:{}} {}\n", "", width, c.report);
    if (c.not_finite > 0)
      out += fmt::format("  {}: {} samples were not finite and counted as zero\n", c.name, c.not_finite);
  }
  out += fmt::format("\nerror of a run's picture:\n  {:{}} {:>22} {:>11} {:>22} {:>11} {:>11} {:>20} {:>8}\n", "",
                     width, "mean MSE", "typical", "mean relMSE", "typical", "med. pixel", "bias", "top 0.1%");
  for (const auto& c : result.configurations) {
    const WindowStatistics& s = c.statistics;
    out +=
        fmt::format("  {:{}} {:>11.4g} {:10} {:>11.4g} {:>11.4g} {:10} {:>11.4g} {:>11.4g} {:>9.2g} {:10} {:>7.1f}%\n",
                    c.name, width, s.mse.mean, give_or_take(s.mse.standard_error), s.mse.typical.value, s.rel_mse.mean,
                    give_or_take(s.rel_mse.standard_error), s.rel_mse.typical.value, s.median_pixel, s.bias,
                    give_or_take(s.bias_error), 100 * s.top_share);
  }
  for (const auto& c : result.configurations) {
    const WindowStatistics& s = c.statistics;
    if (s.mse.typical.has_interval() || s.rel_mse.typical.has_interval())
      out += fmt::format("  {:{}} typical [95%]: MSE {}, relMSE {}\n", c.name, width, interval_text(s.mse.typical),
                         interval_text(s.rel_mse.typical));
    if (first.runs.runs > 1)
      out += fmt::format("  {:{}} variance of a run {:.4g}, squared bias of their mean {:.2g}\n", c.name, width,
                         c.variance, c.bias_squared);
  }
  for (const auto& c : result.configurations)
    if (c.statistics.gains) add_gains(out, c, first.name);
  if (first.runs.runs < kFewestRuns)
    out +=
        fmt::format("\n{}: --repeats {}. Errors after +- are over runs.\n", too_few_runs(first.runs.runs), kFewestRuns);
  for (const auto& c : result.configurations)
    out += tail_remark(c.name, c.statistics) + reference_remark(c.name, c.statistics);
  return out;
}

std::string iterate_json(const IterateResult& result, const BenchTitle& title) {
  Json json{{"command", title.command},
            {"view", title.view},
            {"width", result.width},
            {"height", result.height},
            {"device", result.device},
            {"intersector", result.intersector},
            {"schedule", result.schedule},
            {"samples", samples_of(result.schedule)},
            {"runs", result.configurations.front().runs.runs},
            {"reference",
             {{"from", title.reference},
              {"mean", result.reference.mean},
              {"variance_known", result.reference.variance_known},
              {"variance", result.reference.variance}}},
            {"configurations", Json::array()}};
  for (const auto& c : result.configurations) json["configurations"].push_back(configuration_of(c));
  return json_text(json);
}

}  // namespace fb::lab
