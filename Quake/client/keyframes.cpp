#include "client/keyframes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace fb::cl {
namespace {

bool is_before(const DemoMoment& a, const DemoMoment& b) {
  return std::tie(a.level, a.time) < std::tie(b.level, b.time);
}

}  // namespace

std::size_t Keyframe::bytes() const {
  constexpr std::size_t kName = 64;
  const ClientState& state = session.state;
  return sizeof(Keyframe) + (state.entities.size() + state.statics.size()) * sizeof(Entity) +
         session.effects.particles.particles().size() * sizeof(Particle) +
         (state.model_names.size() + state.sound_names.size() + session.sounds.loops().size()) * kName;
}

bool Keyframes::wants(const DemoMoment& moment) const {
  return std::none_of(frames_.begin(), frames_.end(), [&](const auto& other) {
    return other->moment.level == moment.level && std::abs(other->moment.time - moment.time) < spacing_;
  });
}

void Keyframes::add(std::unique_ptr<const Keyframe> keyframe) {
  bytes_ += keyframe->bytes();
  const auto place = std::upper_bound(frames_.begin(), frames_.end(), keyframe->moment,
                                      [](const DemoMoment& a, const auto& b) { return is_before(a, b->moment); });
  frames_.insert(place, std::move(keyframe));
  while (frames_.size() > 1 && (frames_.size() > most_ || bytes_ > kMostBytes)) {
    const std::size_t count = frames_.size();
    for (std::size_t i = 1; i < frames_.size(); ++i) {
      if (frames_[i]->moment.level != frames_[i - 1]->moment.level) continue;
      bytes_ -= frames_[i]->bytes();
      frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (frames_.size() == count) return;
    spacing_ *= 2.0;
  }
}

const Keyframe* Keyframes::before(const DemoMoment& moment) const {
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), moment,
                                      [](const DemoMoment& a, const auto& b) { return is_before(a, b->moment); });
  if (after == frames_.begin()) return nullptr;
  const Keyframe* const last = std::prev(after)->get();
  return last->moment.level == moment.level ? last : nullptr;
}

}  // namespace fb::cl
