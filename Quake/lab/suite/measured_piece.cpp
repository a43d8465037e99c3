// Raw samples of a suite's piece as JSON: errors, curves and times of every configuration.
#include "lab/suite/measured_piece.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "lab/compare/metrics.h"

namespace fb::lab {
namespace {

// Numbers that JSON cannot say are null.
Json column(const Frames& frames, const std::function<double(const FrameRecord&)>& figure) {
  Json list = Json::array();
  for (const FrameRecord& record : frames.records) list.push_back(record.measured ? Json(figure(record)) : Json());
  return list;
}

Json errors_of(const Frames& frames, bool variance_known) {
  Json errors = Json::object();
  for (const Metric& metric : metrics()) {
    if (!metric.of_frames || !metric.holds(true, variance_known)) continue;
    double sum = 0;
    std::uint32_t count = 0;
    for (std::uint32_t i = frames.warmup; i < frames.warmup + frames.measured; ++i) {
      sum += metric.value(frames.at(0, i).errors);
      ++count;
    }
    errors[metric.name] = sum / count;
  }
  return errors;
}

Json point_of(const Experiment& experiment, const Piece& piece, const ConfigurationResult& c, const BenchResult& all) {
  Json point{{"configuration", c.name},
             {"value", experiment.vary.values[piece.value]},
             {"repeat", piece.repeat},
             {"samples", c.frames.spp},
             {"warmup", c.frames.warmup},
             {"frames", c.frames.measured},
             {"milliseconds", {{"estimator", c.estimator_passes.median}, {"frame", c.all.median}}}};
  Json passes = Json::array();
  for (const ConfigurationResult::Pass& pass : c.passes)
    passes.push_back({{"name", pass.name},
                      {"kind", pass.kind == render::PassKind::kEstimator ? "estimator" : "frame"},
                      {"milliseconds", pass.median}});
  point["passes"] = std::move(passes);
  point["not_finite"] = c.not_finite;
  if (!experiment.errors) return point;
  point["errors"] = errors_of(c.frames, all.reference.variance_known);
  Json curve{{"mse", column(c.frames, [](const FrameRecord& f) { return f.errors.mse_corrected(); })},
             {"rel_mse", column(c.frames, [](const FrameRecord& f) { return f.errors.rel_mse_corrected(); })},
             {"milliseconds", column(c.frames, [](const FrameRecord& f) { return f.estimator_ms; })}};
  if (all.still) {
    curve["running_mse"] = column(c.frames, [](const FrameRecord& f) { return f.running_mse; });
    curve["running_rel_mse"] = column(c.frames, [](const FrameRecord& f) { return f.running_rel_mse; });
    curve["warm_rel_mse"] = Json::array();
    for (std::uint32_t i = c.frames.warmup; i < c.frames.warmup + c.frames.measured; ++i)
      curve["warm_rel_mse"].push_back(c.frames.at(0, i).warm_running_rel_mse);
  }
  point["curve"] = std::move(curve);
  return point;
}

Json iterated_point(const Experiment& experiment, const Piece& piece, const IteratedConfiguration& c,
                    bool variance_known) {
  const FrameRecord& run = c.runs.at(0, 0);
  return {{"configuration", c.name},
          {"value", experiment.vary.values[piece.value]},
          {"repeat", piece.repeat},
          {"samples", c.runs.spp},
          {"warmup", 0},
          {"frames", 1},
          {"schedule", schedule_text(experiment.vary.schedules[piece.value])},
          {"milliseconds", {{"estimator", run.estimator_ms}, {"frame", run.gpu_ms}, {"clock", c.wall_ms.value}}},
          {"passes", Json::array()},
          {"not_finite", c.not_finite},
          {"kept", c.report},
          {"errors", errors_of(c.runs, variance_known)}};
}

}  // namespace

Json iterated_piece(const Experiment& experiment, const Piece& piece, const IterateResult& result, std::uint64_t scene,
                    double reference_error) {
  Json json{{"scene", fmt::format("{:016x}", scene)}, {"still", true}, {"reference_error", reference_error}};
  json["points"] = Json::array();
  for (const IteratedConfiguration& c : result.configurations)
    json["points"].push_back(iterated_point(experiment, piece, c, result.reference.variance_known));
  return json;
}

Json measured_piece(const Experiment& experiment, const Piece& piece, const BenchResult& result, std::uint64_t scene,
                    double reference_error) {
  Json json{{"scene", fmt::format("{:016x}", scene)}, {"still", result.still}};
  if (experiment.errors) json["reference_error"] = reference_error;
  json["points"] = Json::array();
  for (const ConfigurationResult& c : result.configurations)
    json["points"].push_back(point_of(experiment, piece, c, result));
  return json;
}

}  // namespace fb::lab
