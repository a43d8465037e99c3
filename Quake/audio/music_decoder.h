// Music files as frames of two channels: WAV, FLAC (within Ogg, too), Ogg Vorbis, Opus and MP3 by libsndfile, tracker
// modules by libopenmpt. What a file is its bytes say, whatever it is called.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/file_data.h"
#include "base/result.h"

namespace fb::audio {

class MusicDecoder {
 public:
  virtual ~MusicDecoder() = default;
  MusicDecoder(const MusicDecoder&) = delete;
  MusicDecoder& operator=(const MusicDecoder&) = delete;

  std::uint32_t rate() const { return rate_; }  // Hz
  // Fills interleaved pairs; returns how many frames there were: fewer only at the end, or where the file is damaged.
  virtual std::size_t read(std::span<float> stereo) = 0;
  // Back to the start; false if that cannot be.
  virtual bool rewind() = 0;

 protected:
  MusicDecoder() = default;
  std::uint32_t rate_ = 44100;
};

// The extensions of music files, in the order in which they are looked for.
std::span<const std::string_view> music_extensions();

// `name` is that of the file, by whose extension the library is chosen that is asked first; `rate` is what modules are
// played at. Fails with the file's name and that library's reason.
Result<std::unique_ptr<MusicDecoder>> open_music(FileData data, const std::string& name, std::uint32_t rate);

}  // namespace fb::audio
