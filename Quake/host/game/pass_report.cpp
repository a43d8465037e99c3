#include "host/game/pass_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace fb::host {

void PassReport::add(const std::vector<render::PassTime>& passes, const FrameTimes& times) {
  ++frames_;
  times_.whole += times.whole;
  times_.waited += times.waited;
  times_.latency += times.latency;
  for (const render::PassTime& pass : passes) {
    auto same =
        std::find_if(sums_.begin(), sums_.end(), [&](const render::PassTime& s) { return s.name == pass.name; });
    if (same == sums_.end())
      sums_.push_back(pass);
    else
      same->milliseconds += pass.milliseconds;
  }
}

std::string PassReport::line() const {
  double total = 0;
  std::string list;
  for (const render::PassTime& pass : sums_) {
    const double mean = pass.milliseconds / static_cast<double>(frames_);
    total += mean;
    list += fmt::format("{}{} {:.2f}", list.empty() ? "" : ", ", pass.name, mean);
  }
  if (total == 0) return "";
  return fmt::format("gpu ms a frame: {}; {:.2f} in all", list, total);
}

std::string PassReport::times_line() const {
  if (frames_ == 0) return "";
  const auto n = static_cast<double>(frames_);
  return fmt::format("ms a frame: {:.2f}, of these {:.2f} the host's alone; input to picture {:.2f}", times_.whole / n,
                     (times_.whole - times_.waited) / n, times_.latency / n);
}

}  // namespace fb::host
