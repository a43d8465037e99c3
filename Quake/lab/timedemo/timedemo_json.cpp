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

void write_figures(JsonWriter& json, const TimedRun& run) {
  const FrameFigures f = frame_figures(run);
  json.open_object("frame_ms").number("mean", f.mean).number("p1", f.p1).number("p5", f.p5).number("p50", f.p50);
  json.number("p95", f.p95).number("p99", f.p99).number("p99.9", f.p999).close();
  json.number("low_1_percent_fps", f.low_1).number("low_0.1_percent_fps", f.low_01);
  json.open_array("worst");
  for (const std::size_t i : f.worst) {
    const TimedFrame& frame = run.times[i];
    json.open_object().integer("frame", i).integer("message", frame.message).number("demo_seconds", frame.time);
    json.number("frame_ms", frame.whole).close();
  }
  json.close();
}

void write_run(JsonWriter& json, const TimedRun& run) {
  json.open_object().integer("frames", run.frames).number("seconds", run.seconds).number("fps", run.fps());
  write_figures(json, run);
  json.open_object("each_frame").open_array("message");
  for (const TimedFrame& frame : run.times) json.integer("", frame.message);
  json.close();
  for (const Column& column : kColumns) {
    json.open_array(column.name);
    for (const TimedFrame& frame : run.times) json.number("", frame.*column.value);
    json.close();
  }
  json.close().open_array("passes");
  for (const TimedPass& pass : run.passes) {
    json.open_object().text("name", pass.name).text("kind", pass.of_estimator ? "estimator" : "frame");
    json.number("mean_ms", mean(pass.milliseconds)).number("p50_ms", median(pass.milliseconds));
    json.number("p99_ms", quantile(pass.milliseconds, 0.99)).open_array("ms");
    for (const double ms : pass.milliseconds) json.number("", ms);
    json.close().close();
  }
  json.close().close();
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
  JsonWriter json;
  json.open_object().text("format", kTimedemosFormat).boolean("complete", t.complete);
  json.open_object("manifest").text("program", m.program).text("build", m.build).text("device", m.device);
  json.text("driver", m.driver).text("started", m.started).integer("processors", m.processors);
  json.open_array("size").integer("", m.width).integer("", m.height).close().open_object("settings");
  for (const auto& [name, value] : m.settings) json.text(name, value);
  json.close().close().open_array("demos");
  for (const TimedDemo& demo : t.demos) {
    const Estimate fps = fps_over_runs(demo);
    json.open_object().text("name", demo.name).text("hash", demo.hash).number("fps", fps.value);
    json.open_array("fps_interval95").number("", fps.interval.low).number("", fps.interval.high).close();
    json.open_array("runs");
    for (const TimedRun& run : demo.runs) write_run(json, run);
    json.close().close();
  }
  return json.close().close().str();
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
