// Which sounds play on which channels, and how loud: what commands do to the mixer.
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "audio/mixer.h"

namespace fb::audio {

Gains spatialize(const vec3& listener, const vec3& right, const vec3& origin, float volume, float attenuation) {
  const vec3 way = origin - listener;
  const float distance = glm::length(way);
  const float cosine = distance > 0.0f ? glm::dot(right, way) / distance : 0.0f;
  const float loudness = volume * std::max(0.0f, 1.0f - distance * attenuation / kClipDistance);
  return {loudness * std::max(0.0f, 1.0f - cosine), loudness * std::max(0.0f, 1.0f + cosine)};
}

void Mixer::apply(Command command) {
  std::visit([this](auto& one) { on(one); }, command);
}

Gains Mixer::gains_of(const Channel& channel) const {
  if (channel.entity == scene_.entity) return {channel.volume, channel.volume};
  return spatialize(scene_.origin, scene_.right, channel.origin, channel.volume, channel.attenuation);
}

// Ends it where it is.
void Mixer::cut(Voice& voice) {
  if (voice.playing()) cuts_.add(voice.last);
  voice = {};
}

// The channel for a new sound of this entity; null if there is none that may make room.
Mixer::Channel* Mixer::pick(int entity, int channel) {
  Channel* best = nullptr;
  for (Channel& candidate : channels_) {
    if (channel != 0 && candidate.entity == entity && (candidate.channel == channel || channel == -1))
      return &candidate;
    if (!candidate.voice.playing()) {
      if (!best || best->voice.playing()) best = &candidate;
      continue;
    }
    if (candidate.entity == scene_.entity && entity != scene_.entity) continue;
    if (!best || (best->voice.playing() && candidate.voice.frames_left() < best->voice.frames_left()))
      best = &candidate;
  }
  return best;
}

// A sound that another channel begins at the same moment would only be twice as loud: it begins a little further on.
void Mixer::spread_identical(Voice& voice) {
  const bool identical = std::any_of(channels_.begin(), channels_.end(), [&](const Channel& other) {
    return &other.voice != &voice && other.voice.sample == voice.sample && other.voice.fresh;
  });
  const auto most = std::min(static_cast<std::size_t>(kIdenticalSoundSpread * static_cast<float>(rate_)),
                             voice.sample->frames.size());
  if (identical && most > 0) voice.position = rng_.below(static_cast<std::uint32_t>(most));
}

// Where a sound is that began `seconds` ago; none: it has ended.
std::optional<std::size_t> Mixer::position_of(const Sample& sample, double seconds) const {
  const auto played = static_cast<std::size_t>(std::llround(std::clamp(seconds, 0.0, 1e6) * rate_));
  const std::size_t length = sample.frames.size();
  if (played < length) return played;
  if (!sample.loop_start || *sample.loop_start >= length) return std::nullopt;
  return *sample.loop_start + (played - *sample.loop_start) % (length - *sample.loop_start);
}

void Mixer::on(command::Start& start) {
  const std::optional<std::size_t> position = position_of(*start.sample, start.age);
  if (!position) return;
  Channel* const channel = pick(start.entity, start.channel);
  if (!channel) return;
  cut(channel->voice);
  *channel = {};
  channel->entity = start.entity;
  channel->channel = start.channel;
  channel->origin = start.origin;
  channel->volume = start.volume;
  channel->attenuation = start.attenuation;
  channel->voice.gains = gains_of(*channel);
  // One that goes on after a seek may be heard from where the listener is about to be.
  if (channel->voice.gains.silent() && start.age <= 0.0) return;
  channel->voice.sample = std::move(start.sample);
  channel->voice.position = *position;
  if (*position == 0) spread_identical(channel->voice);
}

void Mixer::on(const command::Stop& stop) {
  for (Channel& channel : channels_) {
    if (channel.entity != stop.entity || channel.channel != stop.channel) continue;
    return cut(channel.voice);
  }
}

void Mixer::on(const command::StopAll&) {
  for (Channel& channel : channels_) cut(channel.voice);
  channels_.fill({});
  for (Voice& voice : loops_) cut(voice);
  loops_.clear();
  sources_.clear();
  for (Ambient& ambient : ambients_) {
    SamplePtr sample = ambient.voice.sample;
    cut(ambient.voice);
    ambient.volume = 0.0f;
    ambient.voice.sample = std::move(sample);
    ambient.voice.fresh = false;  // it fades in from silence
  }
}

void Mixer::on(command::Loop& loop) {
  if (sources_.size() == kMostLoops) return;
  std::size_t voice = 0;
  while (voice < loops_.size() && loops_[voice].sample != loop.sample) ++voice;
  if (voice == loops_.size()) loops_.emplace_back().sample = std::move(loop.sample);
  sources_.push_back({voice, loop.origin, loop.volume, loop.attenuation});
}

void Mixer::on(command::Ambients& ambients) {
  for (std::size_t i = 0; i < kAmbients; ++i) {
    if (ambients_[i].voice.sample == ambients.samples[i]) continue;
    cut(ambients_[i].voice);
    ambients_[i] = {};
    ambients_[i].voice.sample = std::move(ambients.samples[i]);
  }
}

void Mixer::on(command::Music& music) {
  if (std::exchange(music_heard_, false)) music_cuts_.add(music_last_);
  music_ = std::move(music.stream);
}

void Mixer::on(const command::Scene& scene) {
  scene_ = scene;
  spatialize_all();
}

void Mixer::spatialize_all() {
  for (Channel& channel : channels_)
    if (channel.voice.playing()) channel.voice.gains = gains_of(channel);
  for (Voice& voice : loops_) voice.gains = {};
  for (const Source& source : sources_) {
    const Gains gains = spatialize(scene_.origin, scene_.right, source.origin, source.volume, source.attenuation);
    loops_[source.voice].gains.left += gains.left;
    loops_[source.voice].gains.right += gains.right;
  }
}

Mixer::Counts Mixer::counts() const {
  Counts counts{0, loops_.size(), sources_.size()};
  for (const Channel& channel : channels_) counts.sounds += channel.voice.playing() ? 1 : 0;
  return counts;
}

}  // namespace fb::audio
