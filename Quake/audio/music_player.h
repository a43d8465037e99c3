// Which music plays: finds files for tracks and names, begins and ends them. On the game's thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "audio/music_stream.h"
#include "base/file_data.h"

namespace fb::audio {

// How near the player's own data a file is, as fs::FileSystem::game_index_of.
using FileRank = std::function<int(std::string_view path)>;

class MusicPlayer {
 public:
  // `send` gives the mixer what it shall play; null for silence.
  MusicPlayer(FileLoader files, FileRank rank, std::function<void(std::shared_ptr<MusicStream>)> send);

  // The rate at which the mixer plays; threaded: see MusicStream. 0: nothing is played.
  void set_output(std::uint32_t rate, int quality, bool threaded);
  // music/trackNN.*, of the game directory named last that has one, by the order of music_extensions(). A track that
  // is missing is silence, as in a game without its disc.
  void play_track(int track);
  // A file of music/, with or without its extension. False after a logged sentence: it cannot be played.
  bool play(std::string_view name);
  void stop();
  // The game and the player may each have paused it.
  void pause_by_game(bool paused);
  void pause_by_player(bool paused);
  void set_looping(bool looping);
  bool looping() const { return looping_; }
  // The file that plays; empty: none.
  std::string playing() const;
  bool paused() const { return by_game_ || by_player_; }
  std::uint64_t frames_missed() const { return missed_ + (stream_ ? stream_->frames_missed() : 0); }
  // Ends what was replaced and is no longer read.
  void collect();

 private:
  std::string find(const std::string& stem) const;
  bool start(const std::string& path);
  void replace(std::shared_ptr<MusicStream> stream);
  void apply_pause();

  FileLoader files_;
  FileRank rank_;
  std::function<void(std::shared_ptr<MusicStream>)> send_;
  std::uint32_t rate_ = 0;
  int quality_ = 1;
  bool threaded_ = true, looping_ = true, by_game_ = false, by_player_ = false;
  std::shared_ptr<MusicStream> stream_;
  std::vector<std::shared_ptr<MusicStream>> replaced_;
  std::uint64_t missed_ = 0;
};

}  // namespace fb::audio
