#include "client/effects/dlights.h"

#include <algorithm>

namespace fb::cl {

void DynamicLights::clear() { lights_ = {}; }

DynamicLight& DynamicLights::allocate(int key, double time) {
  DynamicLight* slot = nullptr;
  std::uint32_t serial = 0;
  if (key != 0) {
    const auto same = std::find_if(lights_.begin(), lights_.end(), [key](const auto& l) { return l.key == key; });
    if (same != lights_.end()) {
      slot = &*same;
      if (slot->lit(time)) serial = slot->serial;  // the same light, moved on
    }
  }
  if (!slot) {
    const auto dead = std::find_if(lights_.begin(), lights_.end(), [time](const auto& l) { return l.die < time; });
    slot = dead != lights_.end() ? &*dead : lights_.data();
  }
  *slot = DynamicLight{};
  slot->key = key;
  slot->serial = serial ? serial : next_serial_++;
  return *slot;
}

void DynamicLights::decay(double time, double seconds) {
  for (DynamicLight& l : lights_)
    if (l.lit(time)) l.radius = std::max(0.0f, l.radius - l.decay * static_cast<float>(seconds));
}

}  // namespace fb::cl
