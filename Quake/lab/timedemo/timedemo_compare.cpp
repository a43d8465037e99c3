#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/rng.h"
#include "lab/json.h"
#include "lab/timedemo/timedemo.h"

namespace fb::lab {
namespace {

constexpr int kResamples = 1000;

using Series2 = std::vector<std::vector<double>>;  // [run][frame], milliseconds

Series2 whole_times(const TimedDemo& demo) {
  Series2 all;
  for (const TimedRun& run : demo.runs) {
    auto& times = all.emplace_back();
    for (const TimedFrame& frame : run.times) times.push_back(frame.whole);
  }
  return all;
}

// Empty where a run lacks the pass.
Series2 pass_times(const TimedDemo& demo, const std::string& name) {
  Series2 all;
  for (const TimedRun& run : demo.runs)
    for (const TimedPass& pass : run.passes)
      if (pass.name == name) all.push_back(pass.milliseconds);
  if (all.size() != demo.runs.size()) all.clear();
  return all;
}

// What stands before each frame of each run, added up: a block's sum is a difference.
Series2 prefix_sums(const Series2& times) {
  Series2 sums;
  for (const auto& run : times) {
    auto& s = sums.emplace_back(1, 0.0);
    for (const double t : run) s.push_back(s.back() + t);
  }
  return sums;
}

double total(const Series2& times) {
  double sum = 0;
  for (const auto& run : times) sum += mean(run);
  return sum / static_cast<double>(times.size());
}

// Ratios under the two-level bootstrap, sorted by nobody: one a resample.
std::vector<double> resampled(const Series2& a, const Series2& b, std::uint64_t seed) {
  const Series2 sums_a = prefix_sums(a), sums_b = prefix_sums(b);
  const auto frames = static_cast<std::uint32_t>(a.front().size());
  const auto block = static_cast<std::uint32_t>(std::max(1.0, std::round(std::cbrt(frames))));
  const std::uint32_t blocks = (frames + block - 1) / block;
  Rng rng(seed);
  std::vector<double> ratios;
  std::vector<std::uint32_t> starts(blocks);
  const auto draw = [&](const Series2& sums) {
    double sum = 0;
    for (std::size_t run = 0; run < sums.size(); ++run) {
      const auto& s = sums[rng.below(static_cast<std::uint32_t>(sums.size()))];
      for (const std::uint32_t start : starts) sum += s[start + block] - s[start];
    }
    return sum / static_cast<double>(sums.size());
  };
  for (int i = 0; i < kResamples; ++i) {
    for (std::uint32_t& start : starts) start = rng.below(frames - block + 1);
    const double time_a = draw(sums_a), time_b = draw(sums_b);
    if (time_a > 0 && time_b > 0) ratios.push_back(time_a / time_b);
  }
  return ratios;
}

Estimate ratio_of(const Series2& a, const Series2& b, const std::vector<double>& ratios) {
  return {total(a) / total(b), {quantile(ratios, 0.025), quantile(ratios, 0.975)}};
}

Status check_demo(const TimedDemo& a, const std::string& name_a, const TimedDemo& b, const std::string& name_b) {
  if (a.hash != b.hash) return Error{fmt::format("{}: another demo in {} than in {}", a.name, name_b, name_a)};
  if (a.runs.empty() || b.runs.empty())
    return Error{fmt::format("{}: {} has no run of it", a.name, a.runs.empty() ? name_a : name_b)};
  const TimedRun& first = a.runs.front();
  for (const TimedDemo* demo : {&a, &b})
    for (const TimedRun& run : demo->runs) {
      if (run.frames != first.frames || run.times.size() != first.times.size())
        return Error{fmt::format("{}: {} frames in a run of {}, {} in {}", a.name, run.frames,
                                 demo == &a ? name_a : name_b, first.frames, name_a)};
      for (std::size_t i = 0; i < run.times.size(); ++i)
        if (run.times[i].message != first.times[i].message)
          return Error{fmt::format("{}: frame {} shows message {} in {}, {} in {}", a.name, i, run.times[i].message,
                                   demo == &a ? name_a : name_b, first.times[i].message, name_a)};
    }
  if (first.times.empty()) return Error{fmt::format("{}: no frame was drawn", a.name)};
  return ok_status();
}

std::vector<std::string> differences(const TimedManifest& a, const TimedManifest& b) {
  std::vector<std::string> list;
  const auto add = [&](std::string_view what, const std::string& x, const std::string& y) {
    if (x != y)
      list.push_back(fmt::format("{}: {} and {}", what, x.empty() ? "nothing" : x, y.empty() ? "nothing" : y));
  };
  add("program", a.program, b.program);
  add("build", a.build, b.build);
  add("device", a.device, b.device);
  add("driver", a.driver, b.driver);
  add("processors", std::to_string(a.processors), std::to_string(b.processors));
  std::map<std::string, std::pair<std::string, std::string>> settings;
  for (const auto& [name, value] : a.settings) settings[name] = {value, "its default"};
  for (const auto& [name, value] : b.settings) {
    auto& both = settings.try_emplace(name, "its default", "").first->second;
    both.second = value;
  }
  for (const auto& [name, values] : settings) add(name, values.first, values.second);
  return list;
}

std::string judgement(const TimedemoComparison& c, const std::string& name_a, const std::string& name_b) {
  const auto& [value, interval] = c.speed;
  const std::string over = fmt::format("over {} demo{}", c.demos.size(), c.demos.size() == 1 ? "" : "s");
  if (interval.low <= 1 && interval.high >= 1)
    return fmt::format("No difference between {} and {} is shown {}: {:.3f} times as fast, 95% [{:.3f}, {:.3f}].",
                       name_a, name_b, over, value, interval.low, interval.high);
  return fmt::format("{} draws {:.3f} times as fast as {} {}, 95% [{:.3f}, {:.3f}]: {}.", name_b, value, name_a, over,
                     interval.low, interval.high, value > 1 ? "faster" : "slower");
}

}  // namespace

Result<TimedemoComparison> compare_timedemos(const Timedemos& a, const std::string& name_a, const Timedemos& b,
                                             const std::string& name_b) {
  for (const auto& [t, name] : {std::pair(&a, &name_a), std::pair(&b, &name_b)})
    if (!t->complete) return Error{fmt::format("{}: its timedemos were not played to their end", *name)};
  const TimedManifest &ma = a.manifest, &mb = b.manifest;
  if (ma.width != mb.width || ma.height != mb.height)
    return Error{
        fmt::format("{} is of {}x{} pixels, {} of {}x{}", name_a, ma.width, ma.height, name_b, mb.width, mb.height)};
  if (a.demos.size() != b.demos.size())
    return Error{fmt::format("{} demos in {}, {} in {}", a.demos.size(), name_a, b.demos.size(), name_b)};
  TimedemoComparison c;
  c.differences = differences(ma, mb);
  double log_speed = 0;
  std::vector<double> log_ratios(kResamples, 0.0);
  for (const TimedDemo& demo : a.demos) {
    const auto other =
        std::find_if(b.demos.begin(), b.demos.end(), [&](const TimedDemo& d) { return d.name == demo.name; });
    if (other == b.demos.end()) return Error{fmt::format("{}: not in {}", demo.name, name_b)};
    if (auto status = check_demo(demo, name_a, *other, name_b); !status) return status.error();
    const Series2 times_a = whole_times(demo), times_b = whole_times(*other);
    const std::vector<double> ratios = resampled(times_a, times_b, c.demos.size() + 1);
    if (ratios.size() != log_ratios.size()) return Error{fmt::format("{}: a run took no time", demo.name)};
    DemoRatio& ratio = c.demos.emplace_back(DemoRatio{demo.name,
                                                      demo.runs.front().frames,
                                                      demo.runs.size(),
                                                      other->runs.size(),
                                                      ratio_of(times_a, times_b, ratios),
                                                      {}});
    for (std::size_t i = 0; i < ratios.size(); ++i) log_ratios[i] += std::log(ratios[i]);
    log_speed += std::log(ratio.speed.value);
    for (const TimedPass& pass : demo.runs.front().passes) {
      const Series2 pass_a = pass_times(demo, pass.name), pass_b = pass_times(*other, pass.name);
      if (pass_a.empty() || pass_b.empty() || !(total(pass_a) > 0) || !(total(pass_b) > 0)) continue;
      ratio.passes.emplace_back(pass.name, ratio_of(pass_a, pass_b, resampled(pass_a, pass_b, 1)));
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(c.demos.size(), 1));
  if (c.demos.empty()) return Error{fmt::format("{} and {} have no demo", name_a, name_b)};
  for (double& v : log_ratios) v = std::exp(v / n);
  c.speed = {std::exp(log_speed / n), {quantile(log_ratios, 0.025), quantile(log_ratios, 0.975)}};
  c.sentence = judgement(c, name_a, name_b);
  return c;
}

std::string comparison_table(const TimedemoComparison& c) {
  std::string out;
  for (const std::string& line : c.differences) out += line + '\n';
  for (const DemoRatio& d : c.demos) {
    const auto row = [&](std::string_view name, const Estimate& e) {
      out += fmt::format("  {:24} {:.3f} [{:.3f}, {:.3f}]\n", name, e.value, e.interval.low, e.interval.high);
    };
    out += fmt::format("{}, {} frames, {} and {} runs; time of the first over the second's, 95%:\n", d.name, d.frames,
                       d.runs_a, d.runs_b);
    row("whole frame", d.speed);
    for (const auto& [name, e] : d.passes) row(name, e);
    if (std::min(d.runs_a, d.runs_b) == 1)
      out += "  One run of a side says nothing of how runs differ: the interval holds for these runs alone.\n";
  }
  return out + c.sentence + '\n';
}

std::string comparison_json(const TimedemoComparison& c) {
  JsonWriter json;
  json.open_object().text("sentence", c.sentence);
  json.estimate("speed", c.speed);
  json.open_array("differences");
  for (const std::string& line : c.differences) json.text("", line);
  json.close().open_array("demos");
  for (const DemoRatio& d : c.demos) {
    json.open_object().text("name", d.name).integer("frames", d.frames);
    json.open_array("runs").integer("", d.runs_a).integer("", d.runs_b).close();
    json.estimate("speed", d.speed);
    json.open_object("passes");
    for (const auto& [name, e] : d.passes) json.estimate(name, e);
    json.close().close();
  }
  return json.close().close().str();
}

}  // namespace fb::lab
