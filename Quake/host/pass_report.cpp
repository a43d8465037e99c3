#include "host/pass_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace fb::host {

void PassReport::add(const std::vector<render::PassTime>& passes) {
  ++frames_;
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

}  // namespace fb::host
