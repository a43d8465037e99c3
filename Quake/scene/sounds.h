// What there is to hear: events, as they happen, and once a frame from where they are heard. The client tells both, the
// mixer (audio/) plays them. Plain data. Positions are in units; volumes are 0..1; a sound of attenuation 1 is silent
// from 1000 units on, one of 0 is heard everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/maths.h"

namespace fb::scene {

// Sounds of an entity are kept apart by its channels (svc_sound): one sound of an entity on a channel ends the one
// before it there. Channel 0 ends none, kAnyChannel ends any of the entity's.
constexpr int kAnyChannel = -1;
constexpr int kNoEntity = -1;

struct SoundStart {
  std::string name;  // "weapons/rocket1i.wav", below sound/
  int entity = kNoEntity, channel = 0;
  vec3 origin{0.0f};
  float volume = 1.0f, attenuation = 1.0f;
  double age = 0.0;  // seconds since it began: what would have ended by now is not heard
};
struct SoundStop {
  int entity = kNoEntity, channel = 0;
};
// One that goes on until the level ends (svc_spawnstaticsound): its file must have a loop.
struct SoundLoop {
  std::string name;
  vec3 origin{0.0f};
  float volume = 1.0f, attenuation = 1.0f;
};
// A level begins, or, without names, the game is left: everything ends but the music.
struct SoundLevel {
  std::vector<std::string> names;  // what the level may play: loaded at once (cvar precache)
};
// svc_cdtrack: music/trackNN.*; 0 is silence.
struct SoundTrack {
  int track = 0;
};
using SoundEvent = std::variant<SoundStart, SoundStop, SoundLoop, SoundLevel, SoundTrack>;
using SoundListener = std::function<void(const SoundEvent&)>;

// In one frame of the game.
struct SoundScene {
  // The listener: the camera, and the entity whose own sounds come from nowhere, at full volume.
  vec3 origin{0.0f}, right{0.0f};
  int entity = 0;
  bool underwater = false;
  // Of the leaf around the listener: how loud water, sky, slime and lava are (0..255).
  std::array<std::uint8_t, 4> ambient{};
  bool paused = false;
  double seconds = 0.0;  // game time that this frame takes
};

}  // namespace fb::scene
