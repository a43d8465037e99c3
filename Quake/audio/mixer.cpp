// Mixes what plays into frames.
#include "audio/mixer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fb::audio {
namespace {

constexpr float kToUnit = 1.0f / 32768.0f;
constexpr float kFilterRate = 44100.0f;  // at which kUnderwaterBase is given
constexpr float kMuteFade = 100.0f;      // a second: fast, without a click

float towards(float from, float to, float step) {
  return from < to ? std::min(to, from + step) : std::max(to, from - step);
}

// From one number to another in a line.
struct Line {
  float from = 0.0f, step = 0.0f;
  Line(float first, float last, std::size_t frames) : from(first), step((last - first) / static_cast<float>(frames)) {}
  float at(std::size_t frame) const { return from + step * static_cast<float>(frame); }
};

}  // namespace

SmoothedStep::SmoothedStep(std::uint32_t rate)
    : length_(std::max<std::size_t>(static_cast<std::size_t>(kStepFade * static_cast<float>(rate)), 1)) {}

void SmoothedStep::add(const Gains& step) {
  if (step.silent()) return;
  value_ = {value_.left + step.left, value_.right + step.right};
  left_ = length_;
  fall_ = {value_.left / static_cast<float>(length_), value_.right / static_cast<float>(length_)};
}

void SmoothedStep::mix(std::span<float> stereo) {
  for (std::size_t i = 0; i < stereo.size() && left_ > 0; i += 2) {
    stereo[i] += value_.left;
    stereo[i + 1] += value_.right;
    value_ = {value_.left - fall_.left, value_.right - fall_.right};
    if (--left_ == 0) value_ = {};
  }
}

Mixer::Mixer(std::uint32_t rate) : rate_(rate), cuts_(rate), music_cuts_(rate) {
  loops_.reserve(kMostLoops);
  sources_.reserve(kMostLoops);
}

void Mixer::mix(std::span<float> stereo) {
  while (!stereo.empty()) {
    const std::span<float> block = stereo.first(std::min(stereo.size(), 2 * kBlock));
    mix_block(block);
    stereo = stereo.subspan(block.size());
  }
}

void Mixer::mix_block(std::span<float> sum) {
  const std::size_t frames = sum.size() / 2;
  std::ranges::fill(sum, 0.0f);
  for (Channel& channel : channels_)
    if (channel.voice.playing()) paint(channel.voice, sum);
  for (Voice& voice : loops_) paint(voice, sum);
  fade_ambients(frames);
  for (Ambient& ambient : ambients_)
    if (ambient.voice.playing()) paint(ambient.voice, sum);
  cuts_.mix(sum);
  if (!std::exchange(mixed_, true)) volume_ = scene_.volume, music_volume_ = scene_.music_volume;
  const Line volume(std::exchange(volume_, scene_.volume), scene_.volume, frames);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = kHeadroom * std::clamp(sum[i] * volume.at(i / 2), -1.0f, 1.0f);
  muffle(sum);
  add_music(sum);
  const float before = audible_;
  audible_ =
      towards(audible_, scene_.muted ? 0.0f : 1.0f, kMuteFade * static_cast<float>(frames) / static_cast<float>(rate_));
  const Line audible(before, audible_, frames);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = audible.at(i / 2) * std::clamp(sum[i], -1.0f, 1.0f);
}

// Adds the voice's next frames. Its loudness goes in a line from what it was to what is wanted, so that a listener who
// moves hears no steps. One that has ended lets its sample go.
void Mixer::paint(Voice& voice, std::span<float> sum) {
  const float most = voice.sample->bits == 8 ? 1.0f : std::numeric_limits<float>::max();
  const Gains to{std::min(voice.gains.left, most), std::min(voice.gains.right, most)};
  const Gains from = voice.fresh ? to : voice.mixed;
  const bool begins_inside = voice.fresh && (voice.position > 0 || voice.sample->loop_start == 0u);
  voice.mixed = to;
  voice.fresh = false;
  const std::size_t frames = sum.size() / 2;
  const Line left(from.left, to.left, frames), right(from.right, to.right, frames);
  if (begins_inside) {
    const float value = -kToUnit * static_cast<float>(voice.sample->frames[voice.position]);
    cuts_.add({value * from.left, value * from.right});
  }
  const bool silent = from.silent() && to.silent();
  for (std::size_t done = 0; done < frames;) {
    const std::size_t count = std::min(frames - done, voice.frames_left());
    const std::int16_t* samples = voice.sample->frames.data() + voice.position;
    for (std::size_t i = 0; i < count && !silent; ++i) {
      const float value = kToUnit * static_cast<float>(samples[i]);
      sum[2 * (done + i)] += value * left.at(done + i);
      sum[2 * (done + i) + 1] += value * right.at(done + i);
    }
    done += count;
    voice.position += count;
    const float value = silent ? 0.0f : kToUnit * static_cast<float>(samples[count - 1]);
    voice.last = {value * left.at(done - 1), value * right.at(done - 1)};
    if (voice.frames_left() > 0) continue;
    if (!voice.sample->loop_start) {
      voice = {};
      return;
    }
    voice.position = *voice.sample->loop_start;
  }
}

void Mixer::fade_ambients(std::size_t frames) {
  const float step = scene_.ambient_fade * static_cast<float>(frames) / static_cast<float>(rate_);
  for (std::size_t i = 0; i < kAmbients; ++i) {
    Ambient& ambient = ambients_[i];
    ambient.volume = towards(ambient.volume, scene_.ambient_volumes[i], step);
    ambient.voice.gains = {ambient.volume, ambient.volume};
  }
}

// A low-pass filter of first order, as Ironwail has it: at strength s each frame goes 12^-s of the way to its input.
void Mixer::muffle(std::span<float> sum) {
  const std::size_t frames = sum.size() / 2;
  if (frames == 0) return;
  underwater_ =
      towards(underwater_, scene_.underwater, kUnderwaterFade * static_cast<float>(frames) / static_cast<float>(rate_));
  if (underwater_ == 0.0f) {
    muffled_ = {sum[sum.size() - 2], sum[sum.size() - 1]};
    return;
  }
  const float rest = 1.0f - std::pow(kUnderwaterBase, -underwater_);
  const float way = 1.0f - std::pow(rest, kFilterRate / static_cast<float>(rate_));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    float& muffled = muffled_[i % 2];
    muffled += way * (sum[i] - muffled);
    sum[i] = muffled;
  }
}

// It may be paused, end or come late anywhere.
void Mixer::add_music(std::span<float> sum) {
  const std::span<float> block = std::span(music_block_).first(sum.size());
  const std::size_t read = music_ ? music_->read(block) : 0, frames = sum.size() / 2;
  const Line gain(kHeadroom * std::exchange(music_volume_, scene_.music_volume), kHeadroom * scene_.music_volume,
                  frames);
  if (read > 0) {
    if (!music_heard_) music_cuts_.add({-gain.from * block[0], -gain.from * block[1]});
    for (std::size_t i = 0; i < 2 * read; ++i) sum[i] += gain.at(i / 2) * block[i];
    const float last = gain.at(read - 1);
    music_last_ = {last * block[2 * read - 2], last * block[2 * read - 1]};
  }
  music_cuts_.mix(sum.first(2 * read));
  if (read < frames && (music_heard_ || read > 0)) music_cuts_.add(music_last_);
  music_cuts_.mix(sum.subspan(2 * read));
  music_heard_ = read == frames;
}

}  // namespace fb::audio
