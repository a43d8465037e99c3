// Where a film's frames go: through a pipe to ffmpeg, or as pictures into a folder. Neither has its final name before
// it is whole: it grows as NAME.part.
#pragma once

#include <memory>
#include <string>

#include "base/result.h"
#include "lab/film/film_frame.h"

namespace fb::lab {

class FilmWriter {
 public:
  virtual ~FilmWriter() = default;
  virtual Status add(const FilmFrame& frame) = 0;
  // The last call: the film gets its name. Returns what was written, for people.
  virtual Result<std::string> finish() = 0;
};

struct FilmOutput {
  std::string path;   // .mp4 or .mkv, or a folder
  std::string sound;  // a wave file that ends with the film; empty: none
  double fps = 30;
  bool exr = false;  // in a folder
};
bool is_film_file(const std::string& path);
// Whether ffmpeg can be run.
bool has_ffmpeg();
// Frames of this size. Fails if the folder exists and holds something, or ffmpeg cannot be started.
Result<std::unique_ptr<FilmWriter>> open_film(const FilmOutput& output, uvec2 size);

}  // namespace fb::lab
