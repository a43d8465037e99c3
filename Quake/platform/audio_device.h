// The device that plays sound: it asks for frames on a thread of its own, at the pace of real time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/result.h"

namespace fb::platform {

class AudioDevice {
 public:
  // Fills frames, interleaved left and right, from -1 to 1. Called on the device's thread; must not wait for another.
  using Fill = std::function<void(std::span<float> stereo)>;

  // Opens the default device of SDL's driver (environment variable SDL_AUDIODRIVER), without beginning to play. It
  // plays at this rate; where the hardware has another, SDL converts. Fails if there is none.
  static Result<std::unique_ptr<AudioDevice>> open(std::uint32_t rate, Fill fill);
  // Once destroyed, it does not call `fill` any more.
  ~AudioDevice();
  AudioDevice(const AudioDevice&) = delete;
  AudioDevice& operator=(const AudioDevice&) = delete;

  void play();
  std::uint32_t rate() const { return rate_; }           // Hz
  std::size_t period() const { return period_; }         // frames that are asked for at a time
  const std::string& driver() const { return driver_; }  // "pulseaudio", "dummy"

 private:
  AudioDevice() = default;
  static void call_fill(void* self, unsigned char* bytes, int count);

  Fill fill_;
  std::uint32_t rate_ = 0, id_ = 0;
  std::size_t period_ = 0;
  std::string driver_;
};

}  // namespace fb::platform
