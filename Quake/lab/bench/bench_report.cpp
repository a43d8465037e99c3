#include "lab/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lab/json.h"

namespace fb::lab {
namespace {

std::string_view name_of(const Window& window) { return window.warm ? "warm" : "cold"; }

void add_gains(std::string& out, const std::string& name, const std::string& baseline, const Gains& g) {
  out += fmt::format("  gain of {} over {}{}\n", name, baseline, g.samples.has_interval() ? " [95%]" : "");
  out += gain_line("equal samples", g.samples);
  out += gain_line("equal samples, of all frames' mean", {g.samples_of_means, {NAN, NAN}});
  out += gain_line("equal time of the estimator", g.time);
  out += gain_line("equal time of all passes", g.time_all);
  out += gain_line("equal time, frames paired", g.time_paired);
  out += gain_line("equal time, of the median frame", g.typical_time);
}

void add_windows(std::string& out, const BenchResult& result) {
  std::size_t width = 13;
  for (const auto& c : result.configurations) width = std::max(width, c.name.size());
  for (std::size_t w = 0; w < result.configurations.front().windows.size(); ++w) {
    const auto& first = result.configurations.front();
    out +=
        fmt::format("\n{}, error of single frames ({} frames{}):\n", name_of(first.windows[w].window),
                    first.frames.measured, first.frames.runs > 1 ? fmt::format(" of {} runs", first.frames.runs) : "");
    out += fmt::format("  {:{}} {:>22} {:>11} {:>20} {:>11} {:>20} {:>8}\n", "", width, "mean MSE", "median MSE",
                       "mean relMSE", "med. pixel", "bias", "top 0.1%");
    for (const auto& c : result.configurations) {
      const WindowStatistics& s = c.windows[w];
      out += fmt::format("  {:{}} {:>11.4g} {:10} {:>11.4g} {:>9.4g} {:10} {:>11.4g} {:>9.2g} {:10} {:>7.1f}%\n",
                         c.name, width, s.mse.mean, give_or_take(s.mse.standard_error), s.mse_median, s.rel_mse.mean,
                         give_or_take(s.rel_mse.standard_error), s.median_pixel, s.bias, give_or_take(s.bias_error),
                         100 * s.top_share);
    }
    for (const auto& c : result.configurations)
      if (c.windows[w].gains) add_gains(out, c.name, first.name, *c.windows[w].gains);
  }
}

// A view that moves: how each configuration follows.
void add_frames(std::string& out, const BenchResult& result) {
  out += "\nMSE of each frame, mean over runs:\n  frame";
  std::vector<std::vector<FrameOverRuns>> lists;
  for (const auto& c : result.configurations) {
    out += fmt::format(" {:>22}", c.name);
    lists.push_back(frames_over_runs(c.frames));
  }
  for (std::size_t i = 0; i < lists.front().size(); ++i) {
    out += fmt::format("\n  {:5}", result.first_frame + lists.front()[i].index);
    for (const auto& list : lists) out += fmt::format(" {:>11.4g} {:10}", list[i].mse, give_or_take(list[i].mse_error));
  }
  out += '\n';
}

void add_running(std::string& out, const BenchResult& result) {
  out += "\nerror of the running average after the last frame, time until then:\n";
  for (const auto& c : result.configurations) {
    for (const WindowStatistics& s : c.windows) {
      const Curve curve = running_curve(c.frames, s.window);
      out += fmt::format("  {} {:5} MSE {:.4g}, relMSE {:.4g}, {:.1f} ms\n", c.name, name_of(s.window),
                         curve.mse.back(), curve.rel_mse.back(), curve.gpu_ms.back());
    }
    out += fmt::format("  {} variance of a frame {:.4g}, squared bias of their mean {}\n", c.name, c.variance,
                       std::isnan(c.bias_squared) ? "unknown: frames are correlated, ask ztest"
                                                  : fmt::format("{:.2g}", c.bias_squared));
  }
}

Json window_of(const ConfigurationResult& c, const WindowStatistics& s, bool still) {
  Json json{{"first_frame", s.window.first},
            {"frames", c.frames.measured},
            {"mse_mean", s.mse.mean},
            {"mse_standard_error", s.mse.standard_error},
            {"mse_of_a_run", json_of(s.mse.typical)},
            {"mse_heavy_tail", s.mse.heavy_tail},
            {"mse_median", s.mse_median},
            {"relmse_mean", s.rel_mse.mean},
            {"relmse_standard_error", s.rel_mse.standard_error},
            {"relmse_of_a_run", json_of(s.rel_mse.typical)},
            {"relmse_median", s.rel_mse_median},
            {"mse_median_pixel", s.median_pixel},
            {"top_share", s.top_share},
            {"bias", s.bias},
            {"bias_standard_error", s.bias_error},
            {"reference_variance", s.reference_variance},
            {"gpu_ms_median", s.gpu_ms},
            {"estimator_gpu_ms_median", s.estimator_ms}};
  if (s.gains)
    json["gain"] = {{"equal_samples", json_of(s.gains->samples)},
                    {"equal_samples_of_means", s.gains->samples_of_means},
                    {"equal_time", json_of(s.gains->time)},
                    {"equal_time_all_passes", json_of(s.gains->time_all)},
                    {"equal_time_paired", json_of(s.gains->time_paired)},
                    {"equal_time_median_frame", json_of(s.gains->typical_time)}};
  if (!still) return json;
  const Curve curve = running_curve(c.frames, s.window);
  json["running_average"] = {{"mse", curve.mse},
                             {"relmse", curve.rel_mse},
                             {"gpu_ms", curve.gpu_ms},
                             {"estimator_gpu_ms", curve.estimator_ms}};
  return json;
}

Json single_frames_of(const Frames& frames, std::uint64_t first_frame) {
  Json json;
  for (const char* column : {"frame", "mse", "mse_standard_error", "relmse", "estimator_gpu_ms"})
    json[column] = Json::array();
  for (const FrameOverRuns& f : frames_over_runs(frames)) {
    json["frame"].push_back(first_frame + f.index);
    json["mse"].push_back(f.mse);
    json["mse_standard_error"].push_back(f.mse_error);
    json["relmse"].push_back(f.rel_mse);
    json["estimator_gpu_ms"].push_back(f.estimator_ms);
  }
  return json;
}

Json configuration_of(const ConfigurationResult& c, bool still, std::uint64_t first_frame) {
  Json json{{"name", c.name},
            {"estimator", c.estimator},
            {"spp", c.frames.spp},
            {"gpu_ms_median", c.all.median},
            {"gpu_ms_p10", c.all.p10},
            {"gpu_ms_p90", c.all.p90},
            {"estimator_gpu_ms_median", c.estimator_passes.median},
            {"estimator_gpu_ms_p10", c.estimator_passes.p10},
            {"estimator_gpu_ms_p90", c.estimator_passes.p90},
            {"passes", Json::array()}};
  for (const auto& pass : c.passes)
    json["passes"].push_back(
        {{"name", pass.name}, {"gpu_ms_median", pass.median}, {"gpu_ms_p10", pass.p10}, {"gpu_ms_p90", pass.p90}});
  json["samples_not_finite"] = c.not_finite;
  if (still) {
    json["variance"] = c.variance;
    json["bias_squared"] = json_of(c.bias_squared);
  }
  for (const WindowStatistics& s : c.windows) json[std::string(name_of(s.window))] = window_of(c, s, still);
  json["single_frames"] = single_frames_of(c.frames, first_frame);
  return json;
}

}  // namespace

std::string give_or_take(double error) { return std::isnan(error) ? "" : fmt::format("+- {:.2g}", error); }

std::string gain_line(std::string_view what, const Estimate& e) {
  std::string out = std::isnan(e.value) ? fmt::format("    {:38} none: the error is the reference's noise", what)
                                        : fmt::format("    {:38} {:.3f}", what, e.value);
  if (e.has_interval()) out += fmt::format(" [{:.3f}, {:.3f}]", e.interval.low, e.interval.high);
  return out + '\n';
}

std::string reference_line(const BenchTitle& title, const ReferenceFigures& figures) {
  return fmt::format("reference: {}; mean {:.4g}, {}\n", title.reference, figures.mean,
                     figures.variance_known ? fmt::format("variance {:.3g} taken off every MSE", figures.variance)
                                            : "variance unknown: its noise is part of every MSE");
}

std::string tail_remark(std::string_view what, const WindowStatistics& s) {
  if (!s.mse.heavy_tail) return "";
  return fmt::format(
      "\n{}: rare samples rule the error (mean MSE {:.4g}, a typical run's {:.4g}); the intervals "
      "cannot cover an event that fewer than a third of the runs meet.\n",
      what, s.mse.mean, s.mse.typical.value);
}

std::string reference_remark(std::string_view what, const WindowStatistics& s) {
  if (s.reference_variance <= 0.1 * s.mse.mean) return "";
  return fmt::format(
      "\nThe reference's variance is more than a tenth of the MSE of {}: give the reference more samples.\n", what);
}

std::string bench_table(const BenchResult& result, const BenchTitle& title) {
  const Frames& shape = result.configurations.front().frames;
  std::string out = fmt::format("{}, {}x{}, {}; {} frames after {} of warm-up, {} runs\n{}, {}\n", title.view,
                                result.width, result.height, result.still ? "still" : "moving", shape.measured,
                                shape.warmup, shape.runs, result.device, result.intersector);
  out += reference_line(title, result.reference);
  out += "\nGPU time, ms, median (p10 to p90):\n";
  for (const auto& c : result.configurations) {
    const auto text = [](const auto& p) {
      return fmt::format("{} {:.2f} ({:.2f} to {:.2f})", p.name, p.median, p.p10, p.p90);
    };
    out += fmt::format("  {}, {} spp: {}; {}", c.name, c.frames.spp, text(c.all), text(c.estimator_passes));
    for (const auto& pass : c.passes) out += fmt::format("; {} {:.2f}", pass.name, pass.median);
    out += '\n';
    if (c.not_finite > 0)
      out += fmt::format("  {}: {} samples were not finite and counted as zero\n", c.name, c.not_finite);
  }
  add_windows(out, result);
  if (result.still)
    add_running(out, result);
  else
    add_frames(out, result);
  if (shape.runs < kFewestRuns)
    out += fmt::format("\n{}: --repeats {}. Errors after +- are over runs.\n", too_few_runs(shape.runs), kFewestRuns);
  for (const auto& c : result.configurations)
    for (const WindowStatistics& s : c.windows) out += tail_remark(fmt::format("{}, {}", c.name, name_of(s.window)), s);
  for (const auto& c : result.configurations) out += reference_remark(c.name, c.windows.back());
  return out;
}

std::string bench_json(const BenchResult& result, const BenchTitle& title) {
  const Frames& shape = result.configurations.front().frames;
  Json json{{"command", title.command},
            {"view", title.view},
            {"still", result.still},
            {"width", result.width},
            {"height", result.height},
            {"device", result.device},
            {"intersector", result.intersector},
            {"runs", shape.runs},
            {"warmup", shape.warmup},
            {"frames", shape.measured},
            {"reference",
             {{"from", title.reference},
              {"mean", result.reference.mean},
              {"variance_known", result.reference.variance_known},
              {"variance", result.reference.variance}}},
            {"configurations", Json::array()}};
  for (const auto& c : result.configurations)
    json["configurations"].push_back(configuration_of(c, result.still, result.first_frame));
  return json_text(json);
}

std::string bench_csv(const BenchResult& result) {
  std::vector<Metric> columns;
  std::copy_if(metrics().begin(), metrics().end(), std::back_inserter(columns),
               [](const Metric& metric) { return metric.of_frames; });
  std::string out = "configuration,run,frame,warm,gpu_ms,estimator_gpu_ms";
  for (const Metric& metric : columns) out += fmt::format(",{}", metric.name);
  out += ",running_mse,running_relmse,warm_running_mse,warm_running_relmse\n";
  for (const auto& c : result.configurations) {
    for (std::uint32_t run = 0; run < c.frames.runs; ++run) {
      for (std::uint32_t i = 0; i < c.frames.warmup + c.frames.measured; ++i) {
        const FrameRecord& f = c.frames.at(run, i);
        const bool warm = c.frames.warmup > 0 && i >= c.frames.warmup;
        out += fmt::format("{},{},{},{},{},{}", c.name, run, i, warm ? 1 : 0, f.gpu_ms, f.estimator_ms);
        for (const Metric& metric : columns) out += f.measured ? fmt::format(",{}", metric.value(f.errors)) : ",";
        out += result.still ? fmt::format(",{},{}", f.running_mse, f.running_rel_mse) : ",,";
        out += result.still && warm ? fmt::format(",{},{}\n", f.warm_running_mse, f.warm_running_rel_mse) : ",,\n";
      }
    }
  }
  return out;
}

}  // namespace fb::lab
