#include "platform/audio_device.h"

#define SDL_MAIN_HANDLED  // SDL must not replace main()
#include <SDL.h>

#include <fmt/format.h>

#include <utility>

namespace fb::platform {
namespace {

// About 21 ms at every rate.
Uint16 period_of(std::uint32_t rate) {
  Uint16 frames = 256;
  while (frames < 8192 && static_cast<std::uint32_t>(frames) * 48 < rate) frames = static_cast<Uint16>(frames * 2);
  return frames;
}

}  // namespace

void AudioDevice::call_fill(void* self, unsigned char* bytes, int count) {
  static_cast<AudioDevice*>(self)->fill_(
      {reinterpret_cast<float*>(bytes), static_cast<std::size_t>(count) / sizeof(float)});
}

Result<std::unique_ptr<AudioDevice>> AudioDevice::open(std::uint32_t rate, Fill fill) {
  SDL_SetMainReady();
  if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0)
    return Error{fmt::format("no sound device could be opened ({})", SDL_GetError())};
  std::unique_ptr<AudioDevice> device(new AudioDevice());  // shuts SDL down if anything below fails
  device->fill_ = std::move(fill);
  SDL_AudioSpec wanted = {}, got = {};
  wanted.freq = static_cast<int>(rate);
  wanted.format = AUDIO_F32SYS;
  wanted.channels = 2;
  wanted.samples = period_of(rate);
  wanted.callback = &call_fill;
  wanted.userdata = device.get();
  device->id_ = SDL_OpenAudioDevice(nullptr, 0, &wanted, &got, 0);
  if (device->id_ == 0) return Error{fmt::format("no sound device could be opened ({})", SDL_GetError())};
  device->rate_ = rate;
  device->period_ = got.samples;
  device->driver_ = SDL_GetCurrentAudioDriver();
  return device;
}

AudioDevice::~AudioDevice() {
  if (id_ != 0) SDL_CloseAudioDevice(id_);
  SDL_QuitSubSystem(SDL_INIT_AUDIO);
}

void AudioDevice::play() { SDL_PauseAudioDevice(id_, 0); }

}  // namespace fb::platform
