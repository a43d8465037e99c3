#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lab/json.h"
#include "lab/timedemo/timedemo.h"

namespace fb::lab {
namespace {

// Mean time of a frame, milliseconds, of each run.
std::vector<double> whole_times(const TimedDemo& demo) {
  std::vector<double> of_runs;
  for (const TimedRun& run : demo.runs) {
    std::vector<double> times;
    for (const TimedFrame& frame : run.times) times.push_back(frame.whole);
    of_runs.push_back(mean(times));
  }
  return of_runs;
}

// Empty where a run lacks the pass.
std::vector<double> pass_times(const TimedDemo& demo, const std::string& name) {
  std::vector<double> of_runs;
  for (const TimedRun& run : demo.runs)
    for (const TimedPass& pass : run.passes)
      if (pass.name == name) of_runs.push_back(mean(pass.milliseconds));
  if (of_runs.size() != demo.runs.size()) of_runs.clear();
  return of_runs;
}

// Geometric means over demos, of each run: a slow minute may touch several demos of a round.
std::vector<double> over_demos(const std::vector<std::vector<double>>& demos) {
  std::size_t runs = demos.front().size();
  for (const auto& demo : demos) runs = std::min(runs, demo.size());
  std::vector<double> means;
  for (std::size_t run = 0; run < runs; ++run) {
    double sum = 0;
    for (const auto& demo : demos) sum += std::log(demo[run]);
    means.push_back(std::exp(sum / static_cast<double>(demos.size())));
  }
  return means;
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
  if (!c.speed.has_interval())
    return fmt::format(
        "{} draws {:.3f} times as fast as {} {}. {} (scr_timedemo_runs): whether that is chance is not known.", name_b,
        value, name_a, over, too_few_runs(c.runs, kFewestSteadyRuns));
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
  std::vector<std::vector<double>> all_a, all_b;
  for (const TimedDemo& demo : a.demos) {
    const auto other =
        std::find_if(b.demos.begin(), b.demos.end(), [&](const TimedDemo& d) { return d.name == demo.name; });
    if (other == b.demos.end()) return Error{fmt::format("{}: not in {}", demo.name, name_b)};
    if (auto status = check_demo(demo, name_a, *other, name_b); !status) return status.error();
    all_a.push_back(whole_times(demo));
    all_b.push_back(whole_times(*other));
    for (const auto* times : {&all_a.back(), &all_b.back()})
      if (std::ranges::any_of(*times, [](double t) { return !(t > 0); }))
        return Error{fmt::format("{}: a run took no time", demo.name)};
    DemoRatio& ratio = c.demos.emplace_back(DemoRatio{demo.name,
                                                      demo.runs.front().frames,
                                                      demo.runs.size(),
                                                      other->runs.size(),
                                                      factor_between(all_a.back(), all_b.back(), kFewestSteadyRuns),
                                                      {}});
    for (const TimedPass& pass : demo.runs.front().passes) {
      const auto pass_a = pass_times(demo, pass.name), pass_b = pass_times(*other, pass.name);
      const Estimate speed = factor_between(pass_a, pass_b, kFewestSteadyRuns);
      if (!std::isnan(speed.value)) ratio.passes.emplace_back(pass.name, speed);
    }
  }
  if (c.demos.empty()) return Error{fmt::format("{} and {} have no demo", name_a, name_b)};
  const auto a_runs = over_demos(all_a), b_runs = over_demos(all_b);
  c.runs = std::min(a_runs.size(), b_runs.size());
  c.speed = factor_between(a_runs, b_runs, kFewestSteadyRuns);
  c.sentence = judgement(c, name_a, name_b);
  return c;
}

std::string comparison_table(const TimedemoComparison& c) {
  std::string out;
  for (const std::string& line : c.differences) out += line + '\n';
  for (const DemoRatio& d : c.demos) {
    const auto row = [&](std::string_view name, const Estimate& e) {
      out += fmt::format("  {:24} {:.3f}", name, e.value);
      if (e.has_interval()) out += fmt::format(" [{:.3f}, {:.3f}]", e.interval.low, e.interval.high);
      out += '\n';
    };
    out += fmt::format("{}, {} frames, {} and {} runs; time of the first over the second's{}:\n", d.name, d.frames,
                       d.runs_a, d.runs_b, d.speed.has_interval() ? ", 95%" : "");
    row("whole frame", d.speed);
    for (const auto& [name, e] : d.passes) row(name, e);
  }
  return out + c.sentence + '\n';
}

std::string comparison_json(const TimedemoComparison& c) {
  Json json{
      {"sentence", c.sentence}, {"speed", json_of(c.speed)}, {"differences", c.differences}, {"demos", Json::array()}};
  for (const DemoRatio& d : c.demos) {
    Json passes = Json::object();
    for (const auto& [name, e] : d.passes) passes[name] = json_of(e);
    json["demos"].push_back({{"name", d.name},
                             {"frames", d.frames},
                             {"runs", {d.runs_a, d.runs_b}},
                             {"speed", json_of(d.speed)},
                             {"passes", std::move(passes)}});
  }
  return json_text(json);
}

}  // namespace fb::lab
