// The light of a map as its author saw it: the baked light says how strong each emitter is.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "scene/authored/gain_field.h"
#include "scene/authored/light_fit.h"

namespace fb::scene {

struct AuthoredLight {
  MapEmitters emitters;
  LightFit fit;
  GainField gains;                         // what the fit leaves
  std::vector<std::uint32_t> lit_through;  // submodels that cast no shadow (closed_doors.h)
  std::size_t points = 0;                  // of the map's faces, at which baked light was compared
  double seconds = 0;                      // that finding it took
};

// Nothing where the map has no baked light, or none that says anything. Takes seconds (Misc/docs/measurements.md);
// the same each time.
std::optional<AuthoredLight> find_authored_light(const LitMap& map, const Lightmaps& lightmaps);

// The same on a thread of its own. What the map refers to and the lightmaps must outlive this; its end stops the work.
class AuthoredTask {
 public:
  AuthoredTask(LitMap map, const Lightmaps& lightmaps);
  AuthoredTask(const AuthoredTask&) = delete;
  AuthoredTask& operator=(const AuthoredTask&) = delete;
  ~AuthoredTask();
  bool ready() const;
  // Once; waits.
  std::optional<AuthoredLight> take();

 private:
  std::atomic<bool> stop_ = false;
  std::future<std::optional<AuthoredLight>> result_;  // last: it waits for the thread, which reads stop_
};

}  // namespace fb::scene
