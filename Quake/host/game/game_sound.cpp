#include "host/game/game_sound.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/log.h"

namespace fb::host {

GameSound::~GameSound() {
  device_.reset();
  engine_.sound().stop();
}

Status GameSound::open(const GameOptions& options) {
  con::Console& console = engine_.console();
  if (options.sound_speed) console.set("sndspeed", std::to_string(*options.sound_speed));
  if (options.mix_speed) console.set("snd_mixspeed", std::to_string(*options.mix_speed));
  if (!options.external_music) engine_.sound().forbid_music();
  const auto rate = static_cast<std::uint32_t>(console.cvar("snd_mixspeed").integer());
  if (!options.wav_capture.empty()) {
    auto file = audio::WavWriter::create(options.wav_capture, rate);
    if (!file) return Error{fmt::format("-wavcapture {}", file.error().message)};
    file_.emplace(std::move(*file));
    engine_.sound().start(rate, audio::SoundOutput::kRecording, options.wav_capture);
    return ok_status();
  }
  if (options.sound && (!options.headless || options.sound_asked)) open_device(rate);
  return ok_status();
}

void GameSound::open_device(std::uint32_t rate) {
  audio::SoundSystem& sound = engine_.sound();
  auto device = platform::AudioDevice::open(rate, [&sound](std::span<float> stereo) { sound.mix(stereo); });
  if (!device) return log_warning("{}; the game is silent", device.error().message);
  device_ = std::move(*device);
  sound.start(device_->rate(), audio::SoundOutput::kDevice, device_->driver());
  log_info("Sound: {}, stereo, {} Hz", device_->driver(), device_->rate());
  device_->play();
}

void GameSound::update(bool focused) {
  const scene::SoundScene scene = engine_.client().sound_scene();
  frame_seconds_ = scene.seconds;
  engine_.sound().update(scene, focused);
}

Status GameSound::record() {
  if (!file_) return ok_status();
  recorded_seconds_ += frame_seconds_;
  const double rate = engine_.console().cvar("snd_mixspeed").value();
  const auto until = static_cast<std::uint64_t>(std::llround(recorded_seconds_ * rate));
  frames_.resize(2 * (until - recorded_frames_));
  recorded_frames_ = until;
  engine_.sound().mix(frames_);
  return file_->write(frames_);
}

Status GameSound::begin_recording(const std::string& path) {
  if (file_) return ok_status();
  const auto rate = static_cast<std::uint32_t>(engine_.console().cvar("snd_mixspeed").integer());
  auto file = audio::WavWriter::create(path, rate);
  if (!file) return file.error();
  had_device_ = device_ != nullptr;
  device_.reset();
  engine_.sound().stop();
  file_.emplace(std::move(*file));
  recorded_seconds_ = 0.0;
  recorded_frames_ = 0;
  recording_ = true;
  engine_.sound().start(rate, audio::SoundOutput::kRecording, path);
  return ok_status();
}

Status GameSound::end_recording() {
  if (!recording_) return ok_status();
  recording_ = false;
  Status status = file_->finish();
  file_.reset();
  engine_.sound().stop();
  if (had_device_) open_device(static_cast<std::uint32_t>(engine_.console().cvar("snd_mixspeed").integer()));
  return status;
}

Status GameSound::finish() { return file_ ? file_->finish() : ok_status(); }

}  // namespace fb::host
