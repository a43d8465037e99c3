#include "client/session/sound_memory.h"

#include <algorithm>
#include <variant>

namespace fb::cl {

void SoundMemory::remember(const scene::SoundEvent& event, double time) {
  std::visit([this, time](const auto& one) { on(one, time); }, event);
}

void SoundMemory::on(const scene::SoundStart& start, double time) {
  std::erase_if(starts_, [&](const Started& other) {
    if (other.start.channel == 0) return time - other.time > kLongest;
    return other.start.entity == start.entity && other.start.channel == start.channel;
  });
  if (starts_.size() == kMostStarts) starts_.erase(starts_.begin());
  starts_.push_back({start, time});
}

void SoundMemory::on(const scene::SoundStop& stop, double) {
  std::erase_if(starts_, [&](const Started& other) {
    return other.start.entity == stop.entity && other.start.channel == stop.channel;
  });
}

void SoundMemory::on(const scene::SoundLoop& loop, double) {
  if (loops_.size() < kMostLoops) loops_.push_back(loop);
}

void SoundMemory::on(const scene::SoundLevel& level, double) {
  starts_.clear();
  loops_.clear();
  if (level.names.empty()) track_ = 0;  // as the music ends, too
}

void SoundMemory::on(const scene::SoundTrack& track, double) { track_ = track.track; }

std::vector<scene::SoundStart> SoundMemory::sounding(double time) const {
  std::vector<scene::SoundStart> sounds;
  for (const Started& started : starts_) {
    sounds.push_back(started.start);
    sounds.back().age = std::max(0.0, time - started.time);
  }
  return sounds;
}

}  // namespace fb::cl
