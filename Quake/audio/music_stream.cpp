#include "audio/music_stream.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "base/log.h"

namespace fb::audio {
namespace {

constexpr std::size_t kSecondsAhead = 2;
constexpr std::size_t kChunk = 4096;  // frames that are decoded at a time
constexpr auto kPoll = std::chrono::milliseconds(50);

}  // namespace

MusicStream::MusicStream(std::unique_ptr<MusicDecoder> decoder, std::string name, std::uint32_t rate, int quality,
                         bool threaded)
    : decoder_(std::move(decoder)),
      name_(std::move(name)),
      resampler_(decoder_->rate(), rate, quality),
      queue_(2 * kSecondsAhead * rate),
      threaded_(threaded) {
  if (threaded_) thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

MusicStream::~MusicStream() = default;

void MusicStream::work(const std::stop_token& stop) {
  while (!stop.stop_requested() && fill()) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, kPoll, [] { return false; });
  }
}

// Decodes until the queue is full. False: there is no more.
bool MusicStream::fill() {
  while (true) {
    const std::size_t pushed = queue_.push(std::span<const float>(chunk_));
    chunk_.erase(chunk_.begin(), chunk_.begin() + static_cast<std::ptrdiff_t>(pushed));
    if (!chunk_.empty()) return true;
    try {
      if (decode_chunk()) continue;
    } catch (const std::exception& failure) {  // also what a library throws for a damaged file
      log_error("{}: {}; it ends here", name_, failure.what());
    }
    decoded_all_ = true;
    return false;
  }
}

// The next frames at the mixing rate, into chunk_. False: there is no more.
bool MusicStream::decode_chunk() {
  const std::size_t reach = resampler_.reach();
  const std::uint64_t held = dropped_ + input_.size() / 2;
  if (!ended_) {
    std::vector<float> decoded(2 * kChunk);
    std::size_t frames = decoder_->read(decoded);
    if (frames == 0 && looping_ && held > 0 && decoder_->rewind()) frames = decoder_->read(decoded);
    if (frames == 0) ended_ = true;
    input_.insert(input_.end(), decoded.begin(), decoded.begin() + static_cast<std::ptrdiff_t>(2 * frames));
  }
  // Without an end the filter waits for all that it looks at; behind the end there is silence.
  const std::uint64_t there = dropped_ + input_.size() / 2;
  const std::uint64_t usable = ended_ ? there : there - std::min<std::uint64_t>(there, reach);
  const std::uint64_t until = std::max<std::uint64_t>(produced_, resampler_.length(usable));
  chunk_.reserve(2 * (until - produced_));
  for (; produced_ < until; ++produced_) {
    for (std::size_t side = 0; side < 2; ++side) {
      chunk_.push_back(resampler_.sample(produced_, [&](std::int64_t i) {
        const std::int64_t at = i - static_cast<std::int64_t>(dropped_);
        return at < 0 || at >= static_cast<std::int64_t>(input_.size() / 2)
                   ? 0.0f
                   : input_[2 * static_cast<std::size_t>(at) + side];
      }));
    }
  }
  const std::uint64_t next = resampler_.position(produced_);
  const std::uint64_t needed = next - std::min<std::uint64_t>(next, reach);
  if (needed > dropped_) {
    const std::uint64_t drop = std::min(needed - dropped_, std::uint64_t{input_.size() / 2});
    input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(2 * drop));
    dropped_ += drop;
  }
  return !ended_ || !chunk_.empty();
}

std::size_t MusicStream::read(std::span<float> stereo) {
  if (paused_ || finished_) return 0;
  if (!threaded_ && !decoded_all_) fill();
  const bool all = decoded_all_;
  const std::size_t read = queue_.pop(stereo) / 2;
  const std::size_t missing = stereo.size() / 2 - read;
  if (read > 0) begun_ = true;
  if (missing > 0 && all) finished_ = true;
  if (missing > 0 && !all && begun_) missed_ += missing;
  return read;
}

}  // namespace fb::audio
