// A piece of music that plays: decoded and brought to the mixing rate on a thread of its own, two seconds ahead, so
// that neither a slow frame of the game nor a slow file makes it stutter. Without the thread, for recordings, it is
// decoded when it is read, and the same reads give the same frames.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "audio/music_decoder.h"
#include "audio/resampler.h"
#include "audio/spsc_queue.h"

namespace fb::audio {

class MusicStream {
 public:
  MusicStream(std::unique_ptr<MusicDecoder> decoder, std::string name, std::uint32_t rate, int quality, bool threaded);
  ~MusicStream();
  MusicStream(const MusicStream&) = delete;
  MusicStream& operator=(const MusicStream&) = delete;

  const std::string& name() const { return name_; }
  void set_looping(bool looping) { looping_ = looping; }
  void set_paused(bool paused) { paused_ = paused; }
  bool paused() const { return paused_; }
  bool finished() const { return finished_; }  // all was read, and it does not loop

  // The mixer's thread: the next frames; returns their number.
  std::size_t read(std::span<float> stereo);
  // Frames that were wanted before they were decoded, but for those before the first.
  std::uint64_t frames_missed() const { return missed_; }

 private:
  void work(const std::stop_token& stop);
  bool fill();
  bool decode_chunk();

  std::unique_ptr<MusicDecoder> decoder_;
  std::string name_;
  Resampler resampler_;
  std::vector<float> input_;    // decoded frames that the filter still looks at
  std::uint64_t dropped_ = 0;   // frames of the input before them
  std::uint64_t produced_ = 0;  // frames at the mixing rate
  bool ended_ = false;          // nothing more comes from the decoder
  std::vector<float> chunk_;    // at the mixing rate, not yet in the queue
  SpscQueue<float> queue_;
  bool threaded_, begun_ = false;
  std::atomic<bool> looping_{true}, paused_{false}, decoded_all_{false}, finished_{false};
  std::atomic<std::uint64_t> missed_{0};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace fb::audio
