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
  static const std::vector<std::string> texts{"",       "FLIP",    "silhouettes", "relMSE",      "trimmed",
                                              "bias %", "flicker", "lag %",       "dark (most)", "bright (most)",
                                              "top %",  "all ms",  "paths",       "gbuffer",     "denoiser"};
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
          plain(kLag, 100),
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

Json lane_of(const Lane& lane, const LaneFigures& figures, const ReferenceFacts& reference) {
  Json json{{"configuration", lane.name}};
  for (std::size_t f = 0; f < kFigureCount; ++f) {
    const auto figure = static_cast<JudgeFigure>(f);
    json[info(figure).key] = json_of(over_seeds(figures, figure, f == kBias ? reference.bias_error : 0));
  }
  json["isolated_dark_most"] = figures.most_dark;
  json["isolated_bright_most"] = figures.most_bright;
  json["pixels_not_finite"] = figures.not_finite;
  json["seeds"] = Json::array();
  for (const Figures& figures_of_seed : figures.seeds) {
    Json& seed = json["seeds"].emplace_back();
    for (std::size_t f = 0; f < kFigureCount; ++f) seed[info(static_cast<JudgeFigure>(f)).key] = figures_of_seed[f];
  }
  return json;
}

Json view_of(const JudgedView& view, const JudgeJob& job) {
  const ReferenceFacts& r = view.figures.reference;
  Json json{{"name", view.view.name},
            {"title", view_title(view.view)},
            {"first_frame", view.view.first},
            {"last_frame", view.view.last},
            {"warmup", view.view.warmup},
            {"exposure", view.exposure},
            {"reference",
             {{"interior_share", r.interior},
              {"mean", r.mean},
              {"epsilon", r.epsilon},
              {"relmse_taken_off", r.rel_variance},
              {"bias_standard_error", r.bias_error},
              {"flip", r.flip}}},
            {"configurations", Json::array()}};
  for (std::size_t i = 0; i < job.lanes.size(); ++i)
    json["configurations"].push_back(lane_of(job.lanes[i], view.figures.lanes[i], r));
  return json;
}

Json summary_of(const std::vector<JudgedView>& views, const JudgeJob& job) {
  const auto figures = figures_of(views);
  Json list = Json::array();
  for (std::size_t i = 0; i < job.lanes.size(); ++i) {
    Json json{{"configuration", job.lanes[i].name}};
    for (std::size_t f = 0; f < kFigureCount; ++f)
      json[info(static_cast<JudgeFigure>(f)).key] = json_of(over_views(figures, i, static_cast<JudgeFigure>(f)));
    const JudgeGain gain = gain_over_first(figures, i, samples_of(job));
    json["gain_equal_samples"] = json_of(gain.equal_samples);
    json["gain_equal_time"] = json_of(gain.equal_time);
    list.push_back(std::move(json));
  }
  return list;
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
      remarks.push_back(
          fmt::format("the reference's noise is more than a tenth of {}'s relMSE: give the references more samples",
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
  Json json{{"command", title.command},
            {"suite", title.suite},
            {"references", title.references},
            {"device", title.device},
            {"width", job.width},
            {"height", job.height},
            {"seeds", job.seeds},
            {"pixels_per_degree", job.pixels_per_degree},
            {"isolated_threshold", kIsolated},
            {"skipped", title.skipped},
            {"other_tone_curves", title.other_curves},
            {"configurations", Json::array()},
            {"views", Json::array()}};
  for (const Lane& lane : job.lanes)
    json["configurations"].push_back({{"name", lane.name},
                                      {"program", lane.program.path},
                                      {"estimator", lane.estimator},
                                      {"spp", lane.spp},
                                      {"set", lane.sets}});
  for (const JudgedView& view : views) json["views"].push_back(view_of(view, job));
  json["summary"] = summary_of(views, job);
  return json_text(json);
}

}  // namespace fb::lab
