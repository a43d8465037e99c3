// SoundSystem: the sound of a game, from what the client says there is to hear (scene/sounds.h) to frames for a device
// or a file. Two threads meet here: the game's calls everything but mix(); whoever plays the frames calls mix(), a
// device on its own thread. Between them is a lock-free queue of commands, so neither waits for the other: however long
// a frame of the game takes, what plays plays on.
//
//   SoundSystem sound(console, files, rank);        // cvars and commands
//   sound.start(device rate, SoundOutput::kDevice);
//   client.set_sound_listener([&](const auto& event) { sound.hear(event); });
//   each frame: sound.update(client.sound_scene(), focused);
//   the device: sound.mix(frames);
//   sound.stop();                                   // after the device's last mix()
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/commands.h"
#include "audio/mixer.h"
#include "audio/music_player.h"
#include "audio/sample.h"
#include "audio/spsc_queue.h"
#include "base/file_data.h"
#include "scene/sounds.h"

namespace fb::con {
class Args;
class Console;
class Cvar;
}  // namespace fb::con

namespace fb::audio {

enum class SoundOutput {
  kDevice,     // mix() is called by another thread, at the pace of real time
  kRecording,  // mix() is called between updates: the same updates give the same frames
};

class SoundSystem {
 public:
  // Registers cvars and commands; the console must outlive it, and executes none of these commands once it is gone.
  SoundSystem(con::Console& console, FileLoader files, FileRank rank);
  ~SoundSystem();
  SoundSystem(const SoundSystem&) = delete;
  SoundSystem& operator=(const SoundSystem&) = delete;

  // Until started, nothing is loaded or played. `output_name` is what soundinfo calls it.
  void start(std::uint32_t rate, SoundOutput output, std::string output_name);
  void stop();
  bool started() const { return mixer_ != nullptr; }
  // No music from files, whatever bgm_extmusic says.
  void forbid_music() {
    music_forbidden_ = true;
    music_allowed_ = false;
  }

  // What has just happened; heard from where update() said last.
  void hear(const scene::SoundEvent& event);
  void update(const scene::SoundScene& scene, bool focused);
  // A sound of the program itself, as of a menu, at full volume: "misc/menu1.wav".
  void play_local(std::string_view name);

  // The next frames, interleaved left and right, from -1 to 1. Silence unless started.
  void mix(std::span<float> stereo);

  struct Figures {
    std::uint64_t frames = 0;      // mixed since the start
    std::uint64_t late = 0;        // calls of mix() that took longer than their frames last: heard as a gap
    std::uint64_t music_late = 0;  // frames of music that came too late
    double longest_wait = 0.0;     // seconds between two calls of mix()
  };
  Figures figures() const;

 private:
  void register_cvars();     // console_commands.cpp
  void register_commands();  // console_commands.cpp
  void play_names(const con::Args& args, bool with_volumes);
  void list_sounds() const;
  void print_info() const;
  void cd_command(const con::Args& args);
  void music_command(const con::Args& args);

  void on(const scene::SoundStart& start);
  void on(const scene::SoundStop& stop);
  void on(const scene::SoundLoop& loop);
  void on(const scene::SoundLevel& level);
  void on(const scene::SoundTrack& track);
  void send_scene(const scene::SoundScene& heard, bool focused);
  void send_ambients();
  void follow_settings();
  void send(Command command);
  void flush();

  con::Console& console_;
  SampleCache samples_;
  MusicPlayer music_;
  std::unique_ptr<Mixer> mixer_;  // the mixing thread's, from start() to stop()
  SpscQueue<Command> queue_;
  std::vector<Command> waiting_;  // those for which the queue had no room
  std::string output_name_;
  std::set<std::string, std::less<>> unlooped_;  // of this level: told of once
  std::size_t loops_ = 0;                        // of this level
  vec3 listener_{0.0f};
  int listener_entity_ = 0, next_played_ = 0, track_ = 0;
  bool music_allowed_ = true, music_forbidden_ = false;
  std::atomic<std::uint64_t> mixed_{0}, late_{0};
  std::atomic<double> longest_wait_{0.0};
  double last_mix_ = 0.0;  // the mixing thread's
};

}  // namespace fb::audio
