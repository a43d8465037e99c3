// r_intersector auto: which of a device's two intersectors is the faster one.
#pragma once

#include <optional>

#include "gpu/device.h"

namespace fb::render {

// Millions of rays a second.
struct IntersectorSpeeds {
  double query = 0, bvh = 0;
};

// Traces the same incoherent rays through a small scene by each; the best of three. The device has ray query. Takes
// tens of milliseconds beside the compilation of two small shaders. Throws OutOfMemory.
IntersectorSpeeds measure_intersectors(gpu::Device& device, std::optional<bool> by_address);

// Whether ray query is faster; measured once in a process for each device and driver, and said in the log.
bool ray_query_is_faster(gpu::Device& device, std::optional<bool> by_address);

}  // namespace fb::render
