#include "audio/music_player.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "base/log.h"

namespace fb::audio {

MusicPlayer::MusicPlayer(FileLoader files, FileRank rank, std::function<void(std::shared_ptr<MusicStream>)> send)
    : files_(std::move(files)), rank_(std::move(rank)), send_(std::move(send)) {}

void MusicPlayer::set_output(std::uint32_t rate, int quality, bool threaded) {
  stop();
  rate_ = rate;
  quality_ = quality;
  threaded_ = threaded;
}

// The best file music/STEM.*: of the game directory named last, by the order of the extensions. Empty: none.
std::string MusicPlayer::find(const std::string& stem) const {
  std::string best;
  int best_rank = std::numeric_limits<int>::min();
  for (const std::string_view extension : music_extensions()) {
    const std::string path = fmt::format("music/{}.{}", stem, extension);
    const int rank = rank_ ? rank_(path) : 0;
    if (rank <= best_rank || !files_ || !files_(path)) continue;
    best = path;
    best_rank = rank;
  }
  return best;
}

void MusicPlayer::play_track(int track) {
  stop();
  if (track == 0 || rate_ == 0) return;
  const std::string path = find(fmt::format("track{:02}", track));
  if (path.empty()) return log_debug("music/track{:02} is missing", track);
  start(path);
}

bool MusicPlayer::play(std::string_view name) {
  stop();
  if (rate_ == 0) return false;
  std::string path = fmt::format("music/{}", name);
  if (!files_ || !files_(path)) path = find(std::string(name));
  if (path.empty()) {
    log_warning("music/{} is missing", name);
    return false;
  }
  return start(path);
}

bool MusicPlayer::start(const std::string& path) {
  auto data = files_(path);
  if (!data) return false;
  auto decoder = open_music(std::move(*data), path, rate_);
  if (!decoder) {
    log_warning("{}", decoder.error().message);
    return false;
  }
  by_player_ = false;
  auto stream = std::make_shared<MusicStream>(std::move(*decoder), path, rate_, quality_, threaded_);
  stream->set_looping(looping_);
  replace(std::move(stream));
  apply_pause();
  return true;
}

void MusicPlayer::replace(std::shared_ptr<MusicStream> stream) {
  if (stream_) {
    missed_ += stream_->frames_missed();
    replaced_.push_back(std::move(stream_));
  }
  stream_ = std::move(stream);
  send_(stream_);
}

void MusicPlayer::stop() {
  if (stream_) replace(nullptr);
}

void MusicPlayer::apply_pause() {
  if (stream_) stream_->set_paused(paused());
}

void MusicPlayer::pause_by_game(bool paused) {
  if (paused == by_game_) return;
  by_game_ = paused;
  apply_pause();
}

void MusicPlayer::pause_by_player(bool paused) {
  by_player_ = paused;
  apply_pause();
}

void MusicPlayer::set_looping(bool looping) {
  looping_ = looping;
  if (stream_) stream_->set_looping(looping);
}

std::string MusicPlayer::playing() const { return stream_ && !stream_->finished() ? stream_->name() : std::string(); }

void MusicPlayer::collect() {
  std::erase_if(replaced_, [](const std::shared_ptr<MusicStream>& stream) { return stream.use_count() == 1; });
}

}  // namespace fb::audio
