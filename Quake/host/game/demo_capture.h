// capturedemo: a demo as a film, every frame of it at an even step of game time however long it takes to draw, with its
// sound.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/maths.h"
#include "console/console.h"
#include "fs/filesystem.h"
#include "host/game/game_sound.h"
#include "lab/film/film_writer.h"

namespace fb::host {

class DemoCapture {
 public:
  // Registers capture_fps, and the commands capturedemo and capturestop.
  DemoCapture(con::Console& console, fs::FileSystem& files, GameSound& sound);
  ~DemoCapture();

  // While it captures, frames last so many seconds of game time, and show what the demo shows alone.
  bool active() const { return state_ != State::kNone; }
  double frame_seconds() const { return 1.0 / fps_; }
  // After each frame of the engine: the film ends with its demo.
  void follow(bool playing);
  // A frame of the demo that was drawn. Pixels as FilmFrame has them; all of one size.
  void add(uvec2 size, std::vector<std::uint32_t> pixels);
  // Ends it: the film gets its name.
  void stop();
  // Ends it without a film.
  void give_up(const std::string& why);

 private:
  enum class State { kNone, kAsked, kPlaying };
  void begin(const con::Args& args);
  std::string sound_path() const { return path_ + ".wav.part"; }

  con::Console& console_;
  fs::FileSystem& files_;
  GameSound& sound_;
  State state_ = State::kNone;
  double fps_ = 30.0;
  std::string path_;
  std::unique_ptr<lab::FilmWriter> film_;
  uvec2 size_{0, 0};
  int frames_asked_ = 0;
};

}  // namespace fb::host
