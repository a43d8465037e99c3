#include "audio/sound_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "base/log.h"
#include "console/console.h"

namespace fb::audio {
namespace {

constexpr std::size_t kQueueSize = 1024;    // commands
constexpr float kFilteredSpeed = 11025.0f;  // sndspeed at which sounds are filtered
constexpr std::array<const char*, kAmbients> kAmbientSounds = {"ambience/water1.wav", "ambience/wind2.wav", nullptr,
                                                               nullptr};
constexpr float kLeastAmbient = 8.0f / 255.0f;  // softer ones are silent

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool concerns_sounds(const Command& command) {
  return std::holds_alternative<command::Loop>(command) || std::holds_alternative<command::Stop>(command);
}

}  // namespace

SoundSystem::SoundSystem(con::Console& console, FileLoader files, FileRank rank)
    : console_(console),
      samples_(files),
      music_(files, std::move(rank),
             [this](std::shared_ptr<MusicStream> stream) { send(command::Music{std::move(stream)}); }),
      queue_(kQueueSize) {
  register_cvars();
  register_commands();
}

SoundSystem::~SoundSystem() { stop(); }

void SoundSystem::start(std::uint32_t rate, SoundOutput output, std::string output_name) {
  stop();
  output_name_ = std::move(output_name);
  mixer_ = std::make_unique<Mixer>(rate);
  mixed_ = late_ = 0;
  longest_wait_ = last_mix_ = 0.0;
  SampleFormat format = samples_.format();
  format.rate = rate;
  samples_.set_format(format);
  music_.set_output(rate, format.quality, output == SoundOutput::kDevice);
  follow_settings();
  send_ambients();
}

void SoundSystem::stop() {
  if (!started()) return;
  music_.set_output(0, 1, false);
  waiting_.clear();
  for (Command command; queue_.pop(command);) command = {};
  mixer_.reset();
  samples_.keep_only({});
  samples_.collect();
  music_.collect();
}

// What the settings say of samples that are loaded from now on.
void SoundSystem::follow_settings() {
  SampleFormat format = samples_.format();
  format.quality = console_.cvar("snd_filterquality").integer();
  format.held = console_.cvar("sndspeed").value() != kFilteredSpeed;
  format.eight_bits = console_.cvar("loadas8bit").on();
  if (format == samples_.format()) return;
  samples_.set_format(format);
  send_ambients();
}

void SoundSystem::send_ambients() {
  command::Ambients ambients;
  for (std::size_t i = 0; i < kAmbients; ++i)
    if (kAmbientSounds[i]) ambients.samples[i] = samples_.load(kAmbientSounds[i]);
  send(std::move(ambients));
}

void SoundSystem::hear(const scene::SoundEvent& event) {
  if (started()) std::visit([this](const auto& one) { on(one); }, event);
}

void SoundSystem::update(const scene::SoundScene& scene, bool focused) {
  if (!started()) return;
  follow_settings();
  listener_ = scene.origin;
  listener_entity_ = scene.entity;
  send_scene(scene, focused);
  music_.pause_by_game(scene.paused);
  const bool allowed = console_.cvar("bgm_extmusic").on() && !music_forbidden_;
  if (allowed != std::exchange(music_allowed_, allowed)) allowed ? music_.play_track(track_) : music_.stop();
  samples_.collect();
  music_.collect();
}

void SoundSystem::send_scene(const scene::SoundScene& heard, bool focused) {
  const auto value = [this](const char* name) { return console_.cvar(name).value(); };
  command::Scene scene;
  scene.origin = heard.origin;
  scene.right = heard.right;
  scene.entity = heard.entity;
  for (std::size_t i = 0; i < kAmbients; ++i) {
    const float volume = value("ambient_level") * static_cast<float>(heard.ambient[i]) / 255.0f;
    scene.ambient_volumes[i] = volume < kLeastAmbient ? 0.0f : volume;
  }
  scene.ambient_fade = value("ambient_fade") / 255.0f;
  scene.underwater = heard.underwater ? value("snd_waterfx") : 0.0f;
  scene.volume = value("volume");
  scene.music_volume = value("bgmvolume");
  scene.muted = !focused && console_.cvar("snd_mute_unfocused").on();
  send(scene);
}

void SoundSystem::on(const scene::SoundStart& start) {
  if (console_.cvar("nosound").on()) return;
  SamplePtr sample = samples_.load(start.name);
  if (!sample) return;
  send(command::Start{std::move(sample), start.entity, start.channel, start.origin, start.volume, start.attenuation,
                      start.age});
}

void SoundSystem::on(const scene::SoundStop& stop) { send(command::Stop{stop.entity, stop.channel}); }

void SoundSystem::on(const scene::SoundLoop& loop) {
  if (console_.cvar("nosound").on()) return;
  SamplePtr sample = samples_.load(loop.name);
  if (!sample) return;
  if (!sample->loop_start) {
    if (unlooped_.insert(loop.name).second) log_warning("sound/{} has no loop, so it is not played on", loop.name);
    return;
  }
  if (++loops_ > kMostLoops) {
    if (loops_ == kMostLoops + 1) log_warning("only {} sounds that play on fit into a level", kMostLoops);
    return;
  }
  send(command::Loop{std::move(sample), loop.origin, loop.volume, loop.attenuation});
}

void SoundSystem::on(const scene::SoundLevel& level) {
  send(command::StopAll{});
  unlooped_.clear();
  loops_ = 0;
  if (level.names.empty()) {
    track_ = 0;
    music_.stop();
    return;
  }
  std::vector<std::string> names = level.names;
  for (const char* ambient : kAmbientSounds)
    if (ambient) names.emplace_back(ambient);
  samples_.keep_only(names);
  if (!console_.cvar("precache").on() || console_.cvar("nosound").on()) return;
  for (const std::string& name : level.names) samples_.load(name);
}

void SoundSystem::on(const scene::SoundTrack& track) {
  track_ = track.track;
  if (music_allowed_) music_.play_track(track.track);
}

void SoundSystem::play_local(std::string_view name) {
  hear(scene::SoundStart{std::string(name), listener_entity_, scene::kAnyChannel, vec3(0.0f), 1.0f, 1.0f});
}

// Where the queue is full, because the device stands still, commands wait here: none is lost but the beginnings of
// sounds, which would be heard too late, and what a later command makes needless. So they stay few.
void SoundSystem::send(Command command) {
  if (!started()) return;
  flush();
  if (waiting_.empty() && queue_.push(command)) return;
  if (std::holds_alternative<command::Start>(command)) return;
  if (std::holds_alternative<command::StopAll>(command)) std::erase_if(waiting_, concerns_sounds);
  if (std::holds_alternative<command::Scene>(command) || std::holds_alternative<command::Music>(command))
    std::erase_if(waiting_, [&](const Command& other) { return other.index() == command.index(); });
  waiting_.push_back(std::move(command));
}

void SoundSystem::flush() {
  auto next = waiting_.begin();
  while (next != waiting_.end() && queue_.push(*next)) ++next;
  waiting_.erase(waiting_.begin(), next);
}

void SoundSystem::mix(std::span<float> stereo) {
  if (!mixer_) {
    std::ranges::fill(stereo, 0.0f);
    return;
  }
  const double begin = steady_seconds();
  if (last_mix_ > 0.0) longest_wait_ = std::max(longest_wait_.load(), begin - last_mix_);
  last_mix_ = begin;
  for (Command command; queue_.pop(command);) mixer_->apply(std::move(command));
  mixer_->mix(stereo);
  const std::size_t frames = stereo.size() / 2;
  mixed_ += frames;
  if (steady_seconds() - begin > static_cast<double>(frames) / mixer_->rate()) ++late_;
}

SoundSystem::Figures SoundSystem::figures() const { return {mixed_, late_, music_.frames_missed(), longest_wait_}; }

}  // namespace fb::audio
