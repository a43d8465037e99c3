// The mixer: Quake's channels, as sums of floats. Pure computation, without threads or devices: commands go in, frames
// come out, and the same ones give the same ones. It allocates nothing while it mixes and frees no sample.
//
// Quake's rules: a sound of an entity ends the one before it on the same channel (scene/sounds.h). If all channels are
// taken, the sound that would end first makes room, but never one of the listener's own for another's. Loudness falls
// linearly to nothing at 1000 units / attenuation; the two sides get 1 + cos and 1 - cos of the angle to the right of
// the listener; the listener's own sounds have neither. Loops that do not end play each sample once, with the sum of
// their loudness. Ambient sounds of a leaf fade towards its levels.
//
// What is cut (by a command, or to make room) or begins in its middle would be a step in the sum, which is heard as a
// click: what it was worth there falls to nothing within 5 ms instead. Sounds begin and end as their files do.
//
// As in QuakeSpasm the sum of all sounds is clipped at full scale and halved, and the music, halved, is added. Sounds
// of 8 bits are not made louder by their direction, those of 16 bits are (Quake's mixer did so).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "audio/commands.h"
#include "base/rng.h"

namespace fb::audio {

constexpr float kClipDistance = 1000.0f;       // units: where a sound of attenuation 1 ends
constexpr std::size_t kDynamicChannels = 128;  // QuakeSpasm's
constexpr std::size_t kMostLoops = 4096;       // sources of loops in a level
constexpr float kHeadroom = 0.5f;              // of sounds and of music
constexpr float kIdenticalSoundSpread = 0.1f;  // seconds: see Mixer::start
constexpr float kStepFade = 0.005f;            // seconds in which a step is smoothed
constexpr float kUnderwaterFade = 4.0f;        // of the filter's strength, a second
constexpr float kUnderwaterBase = 12.0f;       // strength 1: each frame at 44.1 kHz goes 1/12 of the way

struct Gains {
  float left = 0.0f, right = 0.0f;
  bool silent() const { return left == 0.0f && right == 0.0f; }
};
// A value that falls to 0 in a line, in the place of a step.
class SmoothedStep {
 public:
  explicit SmoothedStep(std::uint32_t rate);
  // What was heard stops; or, where it is negative, begins.
  void add(const Gains& step);
  // Adds it to the frames.
  void mix(std::span<float> stereo);

 private:
  std::size_t length_, left_ = 0;  // frames
  Gains value_, fall_;             // now; a frame
};
// Of a sound at `origin`, heard at `listener` with `right` (length 1, or 0: no direction) to its right.
Gains spatialize(const vec3& listener, const vec3& right, const vec3& origin, float volume, float attenuation);

class Mixer {
 public:
  explicit Mixer(std::uint32_t rate);

  std::uint32_t rate() const { return rate_; }
  void apply(Command command);
  // The next frames, interleaved: left, right, left, ...; from -1 to 1.
  void mix(std::span<float> stereo);

  struct Counts {
    std::size_t sounds = 0, loops = 0, sources = 0;  // that play; loops of different samples; sources of loops
  };
  Counts counts() const;

 private:
  // What plays of a sample, and how loud.
  struct Voice {
    SamplePtr sample;
    std::size_t position = 0;
    Gains gains, mixed;  // wanted; at the end of what was mixed
    Gains last;          // the last frame that it added to the sum
    bool fresh = true;   // nothing was mixed: it begins as loud as wanted
    bool playing() const { return sample != nullptr; }
    std::size_t frames_left() const { return sample->frames.size() - position; }
  };
  struct Channel {
    Voice voice;
    int entity = 0, channel = 0;
    vec3 origin{0.0f};
    float volume = 0.0f, attenuation = 0.0f;
  };
  struct Source {  // of a loop
    std::size_t voice = 0;
    vec3 origin{0.0f};
    float volume = 0.0f, attenuation = 0.0f;
  };
  struct Ambient {
    Voice voice;
    float volume = 0.0f;
  };
  static constexpr std::size_t kBlock = 512;  // frames that are mixed at a time

  // mixer_channels.cpp
  void on(command::Start& start);
  void on(const command::Stop& stop);
  void on(const command::StopAll&);
  void on(command::Loop& loop);
  void on(command::Ambients& ambients);
  void on(command::Music& music);
  void on(const command::Scene& scene);
  void cut(Voice& voice);
  Channel* pick(int entity, int channel);
  void spread_identical(Voice& voice);
  std::optional<std::size_t> position_of(const Sample& sample, double seconds) const;
  Gains gains_of(const Channel& channel) const;
  void spatialize_all();

  // mixer.cpp
  void mix_block(std::span<float> stereo);
  void paint(Voice& voice, std::span<float> sum);
  void fade_ambients(std::size_t frames);
  void muffle(std::span<float> sum);
  void add_music(std::span<float> sum);

  std::uint32_t rate_;
  command::Scene scene_;
  std::array<Channel, kDynamicChannels> channels_;
  std::array<Ambient, kAmbients> ambients_;
  std::vector<Voice> loops_;     // room for kMostLoops from the start
  std::vector<Source> sources_;  // the same
  SmoothedStep cuts_;            // of sounds, before their volume
  std::shared_ptr<MusicStream> music_;
  std::array<float, 2 * kBlock> music_block_{};
  Gains music_last_;          // the last frame that it added
  bool music_heard_ = false;  // there was such a frame just now
  SmoothedStep music_cuts_;
  bool mixed_ = false;                         // something was, so that from now on nothing may jump
  float volume_ = 1.0f, music_volume_ = 1.0f;  // at the end of what was mixed
  float underwater_ = 0.0f, audible_ = 1.0f;
  std::array<float, 2> muffled_{};
  Rng rng_{0x736f756e64ull};
};

}  // namespace fb::audio
