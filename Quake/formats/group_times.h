// The end times that precede a group of skins, poses or sprite images. Internal to formats.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/bytes.h"

namespace fb::formats::detail {

// Reads `count` times in seconds, which the caller has checked against the file's size. Returns false if one of them is
// not finite or not positive: then all are replaced by tenths of a second, Quake's own rate. A time below its
// predecessor is raised to it.
inline bool read_group_times(ByteReader& reader, std::size_t count, std::vector<float>& times) {
  bool good = true;
  float latest = 0.0f;
  times.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float time = reader.f32();
    if (!std::isfinite(time) || time <= 0.0f) good = false;
    latest = std::max(latest, time);
    times.push_back(latest);
  }
  if (!good) {
    for (std::size_t i = 0; i < count; ++i) times[i] = 0.1f * static_cast<float>(i + 1);
  }
  return good;
}

}  // namespace fb::formats::detail
