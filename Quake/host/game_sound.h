// The sound of the game's program: joins the engine's sound system with what plays it, a device or a recorded file.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "audio/wav_writer.h"
#include "base/result.h"
#include "host/engine.h"
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

 private:
  void open_device(std::uint32_t rate);

  Engine& engine_;
  std::unique_ptr<platform::AudioDevice> device_;
  std::optional<audio::WavWriter> file_;
  double frame_seconds_ = 0.0, recorded_seconds_ = 0.0;
  std::uint64_t recorded_frames_ = 0;
  std::vector<float> frames_;
};

}  // namespace fb::host
