// What is where in a demo: its levels, their places in the file and their times. The time of a demo runs on through its
// levels, from 0 at the first moment of the first one; that of a level is the server's clock, which each begins anew.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/bytes.h"

namespace fb::cl {

// Between two messages of a demo's file.
struct DemoPlace {
  std::size_t offset = 0;    // bytes
  std::size_t messages = 0;  // before it
};

struct DemoLevel {
  DemoPlace place;                            // of the message that begins it (svc_serverinfo)
  double first_time = 0.0, last_time = -1.0;  // the server's, seconds; last before first: it never begins
  double begins = 0.0;                        // of the demo, seconds
  double seconds() const { return last_time > first_time ? last_time - first_time : 0.0; }
};

// A time of a level: levels count from 0.
struct DemoMoment {
  std::size_t level = 0;
  double time = 0.0;  // the server's, seconds
};

struct DemoIndex {
  std::vector<DemoLevel> levels;

  double seconds() const { return levels.empty() ? 0.0 : levels.back().begins + levels.back().seconds(); }
  // What is shown at a time of the demo; its beginning before it, its end after it.
  DemoMoment moment_at(double seconds) const;
  // The inverse; 0 for a level that is none of the demo's.
  double seconds_at(const DemoMoment& moment) const;
};

// As far as the demo can be understood, and up to where it says that it ends. `name` is for no one: errors are told
// when the demo is played there.
DemoIndex read_demo_index(ByteView data, std::string_view name);

}  // namespace fb::cl
