#include "lab/judge/judge_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lab/json.h"

namespace fb::lab {
namespace {

// The reference's share of relMSE above which more samples are asked for, as in bench.
constexpr double kNoisyReference = 0.1;

std::string number(double value, double factor = 1) {
  return std::isfinite(value) ? fmt::format("{:.3g}", factor * value) : "-";
}
std::string with_interval(const Estimate& e, double factor = 1) {
  if (!std::isfinite(e.value)) return "-";
  if (!e.has_interval()) return number(e.value, factor);
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", factor * e.value, factor * e.interval.low, factor * e.interval.high);
}

// Rows of cells, each column as wide as its widest cell; the first is flush left, the others right.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      out += i == 0 ? fmt::format("  {:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    out += '\n';
  }
  return out;
}

const std::vector<std::string>& heads() {
  static const std::vector<std::string> texts{"",       "FLIP",    "silhouettes", "relMSE",        "trimmed",
                                              "bias %", "flicker", "dark (most)", "bright (most)", "top %",
                                              "all ms", "paths",   "gbuffer",     "denoiser"};
  return texts;
}

// The cells of a lane; `estimate` gives its figures.
template <typename EstimateOf>
std::vector<std::string> cells(const std::string& name, const EstimateOf& estimate, std::uint32_t most_dark,
                               std::uint32_t most_bright) {
  const auto plain = [&](JudgeFigure f, double factor = 1) { return number(estimate(f).value, factor); };
  const auto isolated = [&](JudgeFigure f, std::uint32_t most) { return fmt::format("{} ({})", plain(f), most); };
  return {name,
          with_interval(estimate(kFlip)),
          plain(kFlipEdges),
          with_interval(estimate(kRelMse)),
          with_interval(estimate(kRelMseTrimmed)),
          with_interval(estimate(kBias), 100),
          plain(kFlicker),
          isolated(kDark, most_dark),
          isolated(kBright, most_bright),
          plain(kTopShare, 100),
          with_interval(estimate(kAllMs)),
          plain(kPathsMs),
          plain(kGBufferMs),
          plain(kDenoiserMs)};
}

std::vector<ViewFigures> figures_of(const std::vector<JudgedView>& views) {
  std::vector<ViewFigures> figures;
  for (const JudgedView& view : views) figures.push_back(view.figures);
  return figures;
}

std::vector<std::uint32_t> samples_of(const JudgeJob& job) {
  std::vector<std::uint32_t> spp;
  for (const Lane& lane : job.lanes) spp.push_back(lane.spp);
  return spp;
}

void write_lane(JsonWriter& json, const Lane& lane, const LaneFigures& figures, const ReferenceFacts& reference) {
  json.open_object().text("configuration", lane.name);
  for (std::size_t f = 0; f < kFigureCount; ++f) {
    const auto figure = static_cast<JudgeFigure>(f);
    json.estimate(info(figure).key, over_seeds(figures, figure, f == kBias ? reference.bias_error : 0));
  }
  json.integer("isolated_dark_most", figures.most_dark).integer("isolated_bright_most", figures.most_bright);
  json.integer("pixels_not_finite", figures.not_finite);
  json.open_array("seeds");
  for (const Figures& seed : figures.seeds) {
    json.open_object();
    for (std::size_t f = 0; f < kFigureCount; ++f) json.number(info(static_cast<JudgeFigure>(f)).key, seed[f]);
    json.close();
  }
  json.close().close();
}

void write_view(JsonWriter& json, const JudgedView& view, const JudgeJob& job) {
  json.open_object().text("name", view.view.name).text("title", view_title(view.view));
  json.integer("first_frame", view.view.first).integer("last_frame", view.view.last);
  json.integer("warmup", view.view.warmup).number("exposure", view.exposure);
  const ReferenceFacts& r = view.figures.reference;
  json.open_object("reference")
      .number("interior_share", r.interior)
      .number("mean", r.mean)
      .number("epsilon", r.epsilon);
  json.number("relmse_taken_off", r.rel_variance).number("bias_standard_error", r.bias_error).number("flip", r.flip);
  json.close().open_array("configurations");
  for (std::size_t i = 0; i < job.lanes.size(); ++i) write_lane(json, job.lanes[i], view.figures.lanes[i], r);
  json.close().close();
}

void write_summary(JsonWriter& json, const std::vector<JudgedView>& views, const JudgeJob& job) {
  const auto figures = figures_of(views);
  json.open_array("summary");
  for (std::size_t i = 0; i < job.lanes.size(); ++i) {
    json.open_object().text("configuration", job.lanes[i].name);
    for (std::size_t f = 0; f < kFigureCount; ++f)
      json.estimate(info(static_cast<JudgeFigure>(f)).key, over_views(figures, i, static_cast<JudgeFigure>(f)));
    const JudgeGain gain = gain_over_first(figures, i, samples_of(job));
    json.estimate("gain_equal_samples", gain.equal_samples);
    json.estimate("gain_equal_time", gain.equal_time);
    json.close();
  }
  json.close();
}

}  // namespace

std::string judge_heading(const JudgeJob& job, const JudgeTitle& title) {
  std::string out = fmt::format("{}, {}x{}, {} seeds; references: {}; {}\n", title.suite, job.width, job.height,
                                job.seeds, title.references, title.device);
  if (job.seeds < kFewestSteadyRuns) out += too_few_runs(job.seeds, kFewestSteadyRuns) + ": --seeds\n";
  for (const Lane& lane : job.lanes) {
    out += fmt::format("  {}: {} by {}, {} samples a pixel{}{}\n", lane.name, lane.estimator, lane.program.path,
                       lane.spp, lane.sets.empty() ? "" : ", ", fmt::join(lane.sets, ", "));
  }
  for (const auto* lines : {&title.other_curves, &title.skipped})
    for (const std::string& line : *lines) out += line + '\n';
  return out;
}

std::string view_table(const JudgedView& view, const JudgeJob& job) {
  const ReferenceFacts& r = view.figures.reference;
  std::string out = fmt::format(
      "\n{}\n  exposure {:.4g}; reference: mean {:.4g} inside of surfaces ({:.0f}% of pixels), its noise has a relMSE "
      "of "
      "{:.2g} (taken off) and a FLIP of {:.2g} (not)\n",
      view_title(view.view), view.exposure, r.mean, 100 * r.interior, r.rel_variance, r.flip);
  std::vector<std::vector<std::string>> rows{heads()};
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < job.lanes.size(); ++i) {
    const LaneFigures& lane = view.figures.lanes[i];
    const auto estimate = [&](JudgeFigure f) { return over_seeds(lane, f, f == kBias ? r.bias_error : 0); };
    rows.push_back(cells(job.lanes[i].name, estimate, lane.most_dark, lane.most_bright));
    const double error = estimate(kRelMse).value;
    if (std::isfinite(error) && r.rel_variance > kNoisyReference * error)
      remarks.push_back(fmt::format("the reference's noise is over a tenth of {}'s relMSE: take more samples of it",
                                    job.lanes[i].name));
    if (lane.not_finite > 0)
      remarks.push_back(
          fmt::format("{}: {} pixels were not finite and counted as zero", job.lanes[i].name, lane.not_finite));
  }
  out += aligned(rows);
  for (const std::string& remark : remarks) out += fmt::format("  {}\n", remark);
  return out;
}

std::string summary_table(const std::vector<JudgedView>& views, const JudgeJob& job) {
  if (views.size() < 2) return {};
  const auto figures = figures_of(views);
  std::string out =
      fmt::format("\nall {} views: geometric means; bias, isolated pixels and top % are plain means\n", views.size());
  std::vector<std::vector<std::string>> rows{heads()};
  for (std::size_t i = 0; i < job.lanes.size(); ++i) {
    std::uint32_t dark = 0, bright = 0;
    for (const ViewFigures& view : figures) {
      dark = std::max(dark, view.lanes[i].most_dark);
      bright = std::max(bright, view.lanes[i].most_bright);
    }
    rows.push_back(cells(
        job.lanes[i].name, [&](JudgeFigure f) { return over_views(figures, i, f); }, dark, bright));
  }
  out += aligned(rows);
  for (std::size_t i = 1; i < job.lanes.size(); ++i) {
    const JudgeGain gain = gain_over_first(figures, i, samples_of(job));
    out += fmt::format("  gain of {} over {} in relMSE: equal samples {}, equal time of all passes {}\n",
                       job.lanes[i].name, job.lanes[0].name, with_interval(gain.equal_samples),
                       with_interval(gain.equal_time));
  }
  return out;
}

std::string judge_json(const std::vector<JudgedView>& views, const JudgeJob& job, const JudgeTitle& title) {
  JsonWriter json;
  json.open_object().text("command", title.command).text("suite", title.suite).text("references", title.references);
  json.text("device", title.device);
  json.integer("width", job.width).integer("height", job.height).integer("seeds", job.seeds);
  json.number("pixels_per_degree", job.pixels_per_degree).number("isolated_threshold", double{kIsolated});
  const auto write_lines = [&](std::string_view key, const std::vector<std::string>& lines) {
    json.open_array(key);
    for (const std::string& line : lines) json.text("", line);
    json.close();
  };
  write_lines("skipped", title.skipped);
  write_lines("other_tone_curves", title.other_curves);
  json.open_array("configurations");
  for (const Lane& lane : job.lanes) {
    json.open_object().text("name", lane.name).text("program", lane.program.path).text("estimator", lane.estimator);
    json.integer("spp", lane.spp);
    write_lines("set", lane.sets);
    json.close();
  }
  json.close().open_array("views");
  for (const JudgedView& view : views) write_view(json, view, job);
  json.close();
  write_summary(json, views, job);
  return json.close().str();
}

}  // namespace fb::lab
