// Mixes what plays into frames.
#include "audio/mixer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fb::audio {
namespace {

constexpr float kToUnit = 1.0f / 32768.0f;
constexpr float kFilterRate = 44100.0f;  // at which kUnderwaterBase is given
constexpr float kMuteFade = 100.0f;      // a second: fast, without a click

float towards(float from, float to, float step) {
  return from < to ? std::min(to, from + step) : std::max(to, from - step);
}

}  // namespace

Mixer::Mixer(std::uint32_t rate) : rate_(rate) {
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
  for (float& value : sum) value = kHeadroom * std::clamp(value * scene_.volume, -1.0f, 1.0f);
  muffle(sum);
  add_music(sum);
  const float before = audible_;
  audible_ =
      towards(audible_, scene_.muted ? 0.0f : 1.0f, kMuteFade * static_cast<float>(frames) / static_cast<float>(rate_));
  for (std::size_t i = 0; i < frames; ++i) {
    const float gain = before + (audible_ - before) * static_cast<float>(i) / static_cast<float>(frames);
    sum[2 * i] = gain * std::clamp(sum[2 * i], -1.0f, 1.0f);
    sum[2 * i + 1] = gain * std::clamp(sum[2 * i + 1], -1.0f, 1.0f);
  }
}

// Adds the voice's next frames. Its loudness goes in a line from what it was to what is wanted, so that a listener who
// moves hears no steps. One that has ended lets its sample go.
void Mixer::paint(Voice& voice, std::span<float> sum) {
  const float most = voice.sample->bits == 8 ? 1.0f : std::numeric_limits<float>::max();
  const Gains to{std::min(voice.gains.left, most), std::min(voice.gains.right, most)};
  const Gains from = voice.fresh ? to : voice.mixed;
  voice.mixed = to;
  voice.fresh = false;
  const std::size_t frames = sum.size() / 2;
  const float step = 1.0f / static_cast<float>(frames);
  const float left_step = (to.left - from.left) * step, right_step = (to.right - from.right) * step;
  const bool silent = from.silent() && to.silent();
  for (std::size_t done = 0; done < frames;) {
    const std::size_t count = std::min(frames - done, voice.frames_left());
    const std::int16_t* samples = voice.sample->frames.data() + voice.position;
    for (std::size_t i = 0; i < count && !silent; ++i) {
      const float value = kToUnit * static_cast<float>(samples[i]);
      const auto at = static_cast<float>(done + i);
      sum[2 * (done + i)] += value * (from.left + left_step * at);
      sum[2 * (done + i) + 1] += value * (from.right + right_step * at);
    }
    done += count;
    voice.position += count;
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

void Mixer::add_music(std::span<float> sum) {
  if (!music_) return;
  const std::span<float> block = std::span(music_block_).first(sum.size());
  const std::size_t read = music_->read(block);
  const float gain = kHeadroom * scene_.music_volume;
  for (std::size_t i = 0; i < 2 * read; ++i) sum[i] += gain * block[i];
}

}  // namespace fb::audio
