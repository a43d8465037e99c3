#include "host/game/timedemo_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <span>
#include <thread>

#include "base/hash.h"
#include "base/log.h"
#include "fs/file.h"
#include "host/build_text.h"
#include "host/options.h"

namespace fb::host {
namespace {

std::map<std::string, std::string> changed_settings(const con::Console& console) {
  std::map<std::string, std::string> changed;
  for (const con::Cvar* cvar : console.cvars())
    if (cvar->has_effect() && (cvar->spec().flags & con::kCvarRom) == 0 && cvar->string() != cvar->default_string() &&
        !cvar->name().starts_with("scr_timedemo_"))
      changed[cvar->name()] = cvar->string();
  return changed;
}

}  // namespace

TimedemoReport::TimedemoReport(Engine& engine) : engine_(engine) {
  engine.console().add_cvar("scr_timedemo_json", "",
                            "file in the player's folder that timedemo writes its times to, NAME.json; empty: none");
}

Status TimedemoReport::begin() {
  run_ = {};
  refused_ = false;
  if (engine_.console().cvar("scr_timedemo_json").string().empty()) return ok_status();
  const auto found = path();
  refused_ = !found;
  return found ? ok_status() : Status(found.error());
}

// What a server says must not write over anything else: always NAME.json.
Result<std::filesystem::path> TimedemoReport::path() const {
  std::string name = engine_.console().cvar("scr_timedemo_json").string();
  if (!name.ends_with(".json")) name += ".json";
  auto path = engine_.files().write_path(name);
  if (!path) return Error{"scr_timedemo_json: " + path.error().message};
  return path;
}

void TimedemoReport::add(std::uint64_t message, double demo_seconds, const std::vector<render::PassTime>& passes,
                         const FrameTimes& times) {
  std::vector<lab::TimedRun::PassOfFrame> of_frame;
  for (const render::PassTime& pass : passes)
    of_frame.push_back({pass.name, pass.kind == render::PassKind::kEstimator, pass.milliseconds});
  run_.add({message, demo_seconds, times.whole, times.waited, times.latency}, of_frame);
}

Status TimedemoReport::end(const cl::TimeDemoResult& result, const gpu::DeviceReport& device, uvec2 size) {
  if (refused_) return ok_status();  // that has been said
  if (result.index == 0) {
    all_ = {};
    all_.manifest.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    next_ = 0;
  }
  run_.frames = result.frames;
  run_.seconds = result.seconds;
  lab::TimedDemo& demo = all_.demo(result.demo);
  demo.runs.push_back(std::exchange(run_, {}));
  if (result.whole && result.index == next_) ++next_;
  all_.complete = next_ == result.of;
  if (result.of > 1 && result.index + 1 == result.of)
    for (const std::string& line : lab::timedemo_lines(all_)) log_info("{}", line);
  if (engine_.console().cvar("scr_timedemo_json").string().empty()) return ok_status();
  if (demo.hash.empty()) {
    if (const auto bytes = engine_.files().loader()(result.demo))
      demo.hash = fmt::format("{:016x}", hash_bytes(bytes->data(), bytes->size()));
  }
  return write(device, size);
}

Status TimedemoReport::write(const gpu::DeviceReport& device, uvec2 size) {
  lab::TimedManifest& m = all_.manifest;
  if (m.build.empty()) m.build = build_text();
  m.program = version_text();
  m.device = device.name;
  m.driver = device.driver;
  m.width = size.x;
  m.height = size.y;
  m.processors = std::thread::hardware_concurrency();
  m.settings = changed_settings(engine_.console());
  const auto there = path();
  if (!there) return there.error();
  const std::string text = lab::timedemos_json(all_);
  const Status status = fs::write_text_atomically(*there, text);
  if (status && all_.complete) log_info("wrote {}", there->string());
  return status;
}

}  // namespace fb::host
