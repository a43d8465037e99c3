#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>

#include "fs/file.h"
#include "lab/json.h"
#include "lab/json_reader.h"
#include "lab/timedemo/timedemo.h"

namespace fb::lab {
namespace {

using TimesJson = nlohmann::json;
constexpr const char* kTimedemosFormat = "fullbright timedemos 1";

// The columns of a run's frames.
struct Column {
  const char* name;
  double TimedFrame::*value;
};
constexpr Column kColumns[] = {{"demo_seconds", &TimedFrame::time},
                               {"frame_ms", &TimedFrame::whole},
                               {"waited_ms", &TimedFrame::waited},
                               {"latency_ms", &TimedFrame::latency}};

Json run_of(const TimedRun& run) {
  const FrameFigures f = frame_figures(run);
  Json json{{"frames", run.frames},
            {"seconds", run.seconds},
            {"fps", run.fps()},
            {"frame_ms",
             {{"mean", f.mean},
              {"p1", f.p1},
              {"p5", f.p5},
              {"p50", f.p50},
              {"p95", f.p95},
              {"p99", f.p99},
              {"p99.9", f.p999}}},
            {"low_1_percent_fps", f.low_1},
            {"low_0.1_percent_fps", f.low_01},
            {"worst", Json::array()}};
  for (const std::size_t i : f.worst) {
    const TimedFrame& frame = run.times[i];
    json["worst"].push_back(
        {{"frame", i}, {"message", frame.message}, {"demo_seconds", frame.time}, {"frame_ms", frame.whole}});
  }
  Json& frames = json["each_frame"];
  frames["message"] = Json::array();
  for (const TimedFrame& frame : run.times) frames["message"].push_back(frame.message);
  for (const Column& column : kColumns) {
    Json& values = frames[column.name] = Json::array();
    for (const TimedFrame& frame : run.times) values.push_back(frame.*column.value);
  }
  json["passes"] = Json::array();
  for (const TimedPass& pass : run.passes)
    json["passes"].push_back({{"name", pass.name},
                              {"kind", pass.of_estimator ? "estimator" : "frame"},
                              {"mean_ms", mean(pass.milliseconds)},
                              {"p50_ms", median(pass.milliseconds)},
                              {"p99_ms", quantile(pass.milliseconds, 0.99)},
                              {"ms", pass.milliseconds}});
  return json;
}

TimedManifest read_manifest(const TimesJson& json) {
  TimedManifest m;
  m.program = json.at("program");
  m.build = json.at("build");
  m.device = json.at("device");
  m.driver = json.at("driver");
  m.started = json.at("started");
  m.width = json.at("size").at(0);
  m.height = json.at("size").at(1);
  m.processors = json.at("processors");
  m.settings = json.at("settings");
  return m;
}

TimedRun read_run(const TimesJson& json) {
  TimedRun run;
  run.frames = json.at("frames");
  run.seconds = json.at("seconds");
  const TimesJson& frames = json.at("each_frame");
  for (const TimesJson& message : frames.at("message")) run.times.emplace_back().message = message;
  for (const Column& column : kColumns) {
    const TimesJson& values = frames.at(column.name);
    for (std::size_t i = 0; i < run.times.size(); ++i) run.times[i].*column.value = values.at(i);
  }
  for (const TimesJson& pass : json.at("passes")) {
    TimedPass& added =
        run.passes.emplace_back(TimedPass{pass.at("name"), pass.at("kind") == "estimator", pass.at("ms")});
    if (added.milliseconds.size() != run.times.size())
      throw TimesJson::other_error::create(501, "a pass of other frames", &pass);
  }
  return run;
}

}  // namespace

std::string timedemos_json(const Timedemos& t) {
  const TimedManifest& m = t.manifest;
  Json json{{"format", kTimedemosFormat},
            {"complete", t.complete},
            {"manifest",
             {{"program", m.program},
              {"build", m.build},
              {"device", m.device},
              {"driver", m.driver},
              {"started", m.started},
              {"processors", m.processors},
              {"size", {m.width, m.height}},
              {"settings", Json::object()}}},
            {"demos", Json::array()}};
  for (const auto& [name, value] : m.settings) json["manifest"]["settings"][name] = value;
  for (const TimedDemo& demo : t.demos) {
    const Estimate fps = fps_over_runs(demo);
    Json runs = Json::array();
    for (const TimedRun& run : demo.runs) runs.push_back(run_of(run));
    json["demos"].push_back({{"name", demo.name},
                             {"hash", demo.hash},
                             {"fps", fps.value},
                             {"fps_interval95", {fps.interval.low, fps.interval.high}},
                             {"runs", std::move(runs)}});
  }
  return json_text(json);
}

Result<Timedemos> read_timedemos(const std::string& path) {
  const auto bytes = fs::read_whole_file(path);
  if (!bytes) return bytes.error();
  try {
    const TimesJson json = TimesJson::parse(bytes->data(), bytes->data() + bytes->size());
    if (!json.is_object() || json.value("format", "") != kTimedemosFormat)
      return Error{
          fmt::format("{}: no file of scr_timedemo_json (its \"format\" is not \"{}\")", path, kTimedemosFormat)};
    Timedemos t;
    t.complete = json.at("complete");
    t.manifest = read_manifest(json.at("manifest"));
    for (const TimesJson& demo : json.at("demos")) {
      TimedDemo& added = t.demos.emplace_back(TimedDemo{demo.at("name"), demo.at("hash"), {}});
      for (const TimesJson& run : demo.at("runs")) added.runs.push_back(read_run(run));
    }
    return t;
  } catch (const TimesJson::exception& error) {
    return Error{fmt::format("{}: {}", path, sentence_of(error))};
  }
}

}  // namespace fb::lab
