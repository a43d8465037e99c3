// The game's timedemos for scr_timedemo_json: gathers the frames of each run, and writes the file after each run has
// ended, so that writing takes nothing of what is measured. The first frame that is drawn is not one of them: as in the
// classic count, it holds what was loaded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/maths.h"
#include "client/client.h"
#include "gpu/device.h"
#include "host/game/engine.h"
#include "host/game/pass_report.h"
#include "lab/timedemo/timedemo.h"

namespace fb::host {

class TimedemoReport {
 public:
  explicit TimedemoReport(Engine& engine);  // registers the cvar

  // Fails if the file is wanted where it cannot be written: the run is in vain, and its end says nothing.
  Status begin();
  void add(std::uint64_t message, double demo_seconds, const std::vector<render::PassTime>& passes,
           const FrameTimes& times);
  // The run has ended so; says what a list comes to once its last has ended. Fails if the file cannot be written.
  Status end(const cl::TimeDemoResult& result, const gpu::DeviceReport& device, uvec2 size);

 private:
  Status write(const gpu::DeviceReport& device, uvec2 size);
  Result<std::filesystem::path> path() const;

  Engine& engine_;
  lab::Timedemos all_;
  lab::TimedRun run_;
  bool refused_ = false;
  int next_ = 0;  // index of the run that is wanted next, if all before it ended
};

}  // namespace fb::host
