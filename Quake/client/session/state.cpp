#include "client/session/state.h"

#include <algorithm>
#include <cmath>

namespace fb::cl {

float light_style_value(const std::string& pattern, double time) {
  if (pattern.empty()) return 1.0f;
  const auto step = static_cast<std::uint64_t>(std::max(0.0, std::floor(time * 10.0)));
  const char letter = pattern[step % pattern.size()];
  return static_cast<float>(std::clamp(letter - 'a', 0, 25)) / static_cast<float>('m' - 'a');
}

Fog fog_at(const FogState& fog, double time) {
  if (fog.fade_seconds <= 0.0 || fog.fade_done <= time) return fog.now;
  const auto f = static_cast<float>(std::clamp((fog.fade_done - time) / fog.fade_seconds, 0.0, 1.0));
  Fog mixed;
  mixed.density = glm::mix(fog.now.density, fog.before.density, f);
  mixed.color = glm::mix(fog.now.color, fog.before.color, f);
  return mixed;
}

void change_fog(FogState& fog, const Fog& to, double fade_seconds, double time) {
  if (fade_seconds > 0.0) fog.before = fog_at(fog, time);
  fog.now = to;
  fog.fade_seconds = fade_seconds;
  fog.fade_done = time + fade_seconds;
}

}  // namespace fb::cl
