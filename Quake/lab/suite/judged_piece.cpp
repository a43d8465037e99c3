#include "lab/suite/judged_piece.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/number.h"

namespace fb::lab {
namespace {

constexpr auto kTimes = std::to_array<std::pair<JudgeFigure, const char*>>(
    {{kPathsMs, "estimator"}, {kAllMs, "frame"}, {kGBufferMs, "gbuffer"}, {kDenoiserMs, "denoiser"}});

bool is_time(JudgeFigure figure) {
  return std::any_of(kTimes.begin(), kTimes.end(), [&](const auto& time) { return time.first == figure; });
}

double number_of(const Json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

constexpr auto kFacts = std::to_array<std::pair<const char*, double ReferenceFacts::*>>(
    {{"interior_share", &ReferenceFacts::interior},
     {"mean", &ReferenceFacts::mean},
     {"epsilon", &ReferenceFacts::epsilon},
     {"relmse_taken_off", &ReferenceFacts::rel_variance},
     {"bias_standard_error", &ReferenceFacts::bias_error},
     {"flip", &ReferenceFacts::flip}});

// What was refused where it is no number.
std::uint32_t samples_of(const ExperimentConfiguration& configuration) {
  std::uint32_t samples = 1;
  for (const std::string& set : configuration.sets)
    if (set.starts_with("r_spp="))
      samples = static_cast<std::uint32_t>(parse_whole_number_unsigned(set.substr(6)).value_or(samples));
  return samples;
}

Json point_of(const Experiment& experiment, const Piece& piece, const Lane& lane, const LaneFigures& figures,
              const PassTimes& times) {
  Json point{{"configuration", lane.name},       {"value", experiment.vary.values[piece.value]},
             {"repeat", piece.repeat},           {"samples", lane.spp},
             {"warmup", experiment.view.warmup}, {"frames", experiment.view.frames()}};
  const Figures& seed = figures.seeds.front();
  for (const auto& [figure, name] : kTimes) point["milliseconds"][name] = json_of(seed[figure]);
  point["passes"] = Json::array();
  for (const PassTimes::Pass& pass : times.passes)
    point["passes"].push_back(
        {{"name", pass.name}, {"kind", pass.estimators ? "estimator" : "frame"}, {"milliseconds", pass.milliseconds}});
  point["not_finite"] = figures.not_finite;
  for (std::size_t f = 0; f < kFigureCount; ++f)
    if (const auto figure = static_cast<JudgeFigure>(f); !is_time(figure))
      point["errors"][info(figure).key] = json_of(seed[f]);
  point["most"] = {{"isolated_dark", figures.most_dark}, {"isolated_bright", figures.most_bright}};
  return point;
}

Json lane_estimates(const std::string& name, const auto& estimate, std::uint32_t most_dark, std::uint32_t most_bright) {
  Json json{{"configuration", name}};
  for (std::size_t f = 0; f < kFigureCount; ++f)
    json[info(static_cast<JudgeFigure>(f)).key] = json_of(estimate(static_cast<JudgeFigure>(f)));
  json["most"] = {{"isolated_dark", most_dark}, {"isolated_bright", most_bright}};
  return json;
}

}  // namespace

Json judged_piece(const Experiment& experiment, const Piece& piece, const JudgedView& view,
                  const std::vector<Lane>& lanes, const std::vector<PassTimes>& times, std::uint64_t scene) {
  Json json{{"scene", fmt::format("{:016x}", scene)}};
  json["truth"]["exposure"] = view.exposure;
  for (const auto& [name, member] : kFacts) json["truth"][name] = json_of(view.figures.reference.*member);
  json["reference_error"] = json_of(view.figures.reference.bias_error);
  json["points"] = Json::array();
  for (std::size_t i = 0; i < lanes.size(); ++i)
    json["points"].push_back(point_of(experiment, piece, lanes[i], view.figures.lanes[i], times[i]));
  return json;
}

ViewFigures judged_figures(const Experiment& experiment, const Json& points, const Json& truth) {
  ViewFigures view;
  for (const auto& [name, member] : kFacts) view.reference.*member = number_of(truth[name]);
  for (const ExperimentConfiguration& configuration : experiment.configurations) {
    LaneFigures& lane = view.lanes.emplace_back();
    for (const Json& point : points) {
      if (point["configuration"] != configuration.name) continue;
      Figures& seed = lane.seeds.emplace_back(unknown_figures());
      for (std::size_t f = 0; f < kFigureCount; ++f)
        if (const auto figure = static_cast<JudgeFigure>(f); !is_time(figure))
          seed[f] = number_of(point["errors"][info(figure).key]);
      for (const auto& [figure, name] : kTimes) seed[figure] = number_of(point["milliseconds"][name]);
      lane.most_dark = std::max(lane.most_dark, point["most"]["isolated_dark"].get<std::uint32_t>());
      lane.most_bright = std::max(lane.most_bright, point["most"]["isolated_bright"].get<std::uint32_t>());
      lane.not_finite += point["not_finite"].get<std::uint64_t>();
    }
  }
  return view;
}

Json judged_estimates(const Experiment& experiment, const ViewFigures& figures) {
  Json list = Json::array();
  for (std::size_t i = 0; i < figures.lanes.size(); ++i) {
    const LaneFigures& lane = figures.lanes[i];
    const auto estimate = [&](JudgeFigure f) {
      return over_seeds(lane, f, f == kBias ? figures.reference.bias_error : 0);
    };
    list.push_back(lane_estimates(experiment.configurations[i].name, estimate, lane.most_dark, lane.most_bright));
  }
  return list;
}

Json judged_summary(const std::vector<const Experiment*>& experiments, const std::vector<ViewFigures>& figures) {
  const auto& configurations = experiments.front()->configurations;
  std::vector<std::uint32_t> samples;
  for (const ExperimentConfiguration& configuration : configurations) samples.push_back(samples_of(configuration));
  Json list = Json::array();
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    std::uint32_t dark = 0, bright = 0;
    for (const ViewFigures& view : figures) {
      dark = std::max(dark, view.lanes[i].most_dark);
      bright = std::max(bright, view.lanes[i].most_bright);
    }
    const auto estimate = [&](JudgeFigure f) { return over_views(figures, i, f); };
    Json lane = lane_estimates(configurations[i].name, estimate, dark, bright);
    const JudgeGain gain = gain_over_first(figures, i, samples);
    lane["gain_equal_samples"] = json_of(gain.equal_samples);
    lane["gain_equal_time"] = json_of(gain.equal_time);
    list.push_back(std::move(lane));
  }
  return list;
}

}  // namespace fb::lab
