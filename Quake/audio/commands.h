// What the game's thread tells the mixer, in order, through a lock-free queue.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <variant>

#include "audio/music_stream.h"
#include "audio/sample.h"
#include "base/maths.h"

namespace fb::audio {

constexpr std::size_t kAmbients = 4;

namespace command {

struct Start {
  SamplePtr sample;
  int entity = 0, channel = 0;  // scene/sounds.h
  vec3 origin{0.0f};
  float volume = 1.0f, attenuation = 1.0f;
  double age = 0.0;  // seconds of it that have gone by
};
struct Stop {
  int entity = 0, channel = 0;
};
// Ends all sounds; the music goes on.
struct StopAll {};
// The sample must have a loop.
struct Loop {
  SamplePtr sample;
  vec3 origin{0.0f};
  float volume = 1.0f, attenuation = 1.0f;
};
struct Ambients {
  std::array<SamplePtr, kAmbients> samples;  // null: silent
};
// Null: none.
struct Music {
  std::shared_ptr<MusicStream> stream;
};
// What is heard, and how, from now on: once a frame.
struct Scene {
  vec3 origin{0.0f}, right{0.0f};
  int entity = 0;
  std::array<float, kAmbients> ambient_volumes{};  // towards which they fade, 0..1
  float ambient_fade = 0.0f;                       // a second
  float underwater = 0.0f;                         // strength of the muffling filter, towards which it fades
  float volume = 1.0f, music_volume = 1.0f;
  bool muted = false;
};

}  // namespace command

using Command = std::variant<command::Scene, command::Start, command::Stop, command::StopAll, command::Loop,
                             command::Ambients, command::Music>;

}  // namespace fb::audio
