// The sound of the game's program: joins the engine's sound system with what plays it, a device or a recorded file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audio/wav_writer.h"
#include "base/result.h"
#include "host/game/engine.h"
#include "host/options.h"
#include "platform/audio_device.h"

namespace fb::host {

class GameSound {
 public:
  explicit GameSound(Engine& engine) : engine_(engine) {}
  // The device stops before the sound system does.
  ~GameSound();
  GameSound(const GameSound&) = delete;
  GameSound& operator=(const GameSound&) = delete;

  // As the options say. Without a device the game is silent, after one sentence; fails only if a file to record into
  // cannot be created.
  Status open(const GameOptions& options);
  // After each frame of the engine.
  void update(bool focused);
  // After each frame that was drawn: records the sound of as much game time as it takes. The same frames give the same
  // file; a picture of each (-capture) and the file are a film.
  Status record();
  // Completes the file.
  Status finish();

  // Records into a file while the game goes on, in the place of the device; then the device plays again, if there was
  // one. Does nothing where the game is recorded already (-wavcapture). Fails if the file cannot be created.
  Status begin_recording(const std::string& path);
  bool records() const { return recording_; }
  Status end_recording();

 private:
  void open_device(std::uint32_t rate);

  Engine& engine_;
  std::unique_ptr<platform::AudioDevice> device_;
  std::optional<audio::WavWriter> file_;
  bool recording_ = false, had_device_ = false;  // begin_recording
  double frame_seconds_ = 0.0, recorded_seconds_ = 0.0;
  std::uint64_t recorded_frames_ = 0;
  std::vector<float> frames_;
};

}  // namespace fb::host
