#include "host/game/demo_capture.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "base/log.h"

namespace fb::host {
namespace {

constexpr int kFramesToBegin = 10;  // a demo that does not play by then was not found

}  // namespace

DemoCapture::DemoCapture(con::Console& console, fs::FileSystem& files, GameSound& sound)
    : console_(console), files_(files), sound_(sound) {
  console.add_cvar({"capture_fps", "30", "frames a second of films that capturedemo makes", con::kCvarArchive, 1, 240});
  console.add_command(
      "capturedemo",
      "capturedemo <demo> [film]: play a demo and save it as captures/FILM.mp4 (default: the demo's name; .mkv, or a "
      "folder's name for pictures) with its sound, capture_fps frames a second however long they take",
      [this](const con::Args& args) { begin(args); });
  console.add_command("capturestop", "capturestop: end the film that capturedemo makes", [this](const con::Args&) {
    if (!active()) return log_info("no demo is captured");
    stop();
    console_.insert("stopdemo\n");
  });
}

DemoCapture::~DemoCapture() { stop(); }

void DemoCapture::begin(const con::Args& args) {
  if (args.size() < 2 || args.size() > 3) return log_info("capturedemo <demo> [film]");
  if (active()) return console_.fail("capturedemo: a demo is captured already; capturestop ends it");
  const std::string stem = std::filesystem::path(args[1]).stem().string();
  const std::string name = args.size() > 2 ? args[2] : stem + (lab::has_ffmpeg() ? ".mp4" : "");
  if (lab::is_film_file(name) && !lab::has_ffmpeg())
    return console_.fail(fmt::format(
        "capturedemo: {} needs ffmpeg, which is not there; a name without .mp4 or .mkv is a folder for pictures",
        name));
  const auto path = files_.write_path("captures/" + name);
  if (!path) return console_.fail(path.error().message);
  std::error_code failed;
  std::filesystem::create_directories(path->parent_path(), failed);
  path_ = path->string();
  fps_ = static_cast<double>(console_.cvar("capture_fps").value());
  if (auto status = sound_.begin_recording(sound_path()); !status) return console_.fail(status.error().message);
  size_ = uvec2(0);
  frames_asked_ = 0;
  state_ = State::kAsked;
  log_info("capturing {} as {}, {:g} frames a second; capturestop ends it", args[1], path_, fps_);
  console_.insert("playdemo \"" + args[1] + "\"\n");
}

void DemoCapture::follow(bool playing) {
  if (state_ == State::kAsked && playing) state_ = State::kPlaying;
  if (state_ == State::kAsked && ++frames_asked_ > kFramesToBegin) give_up("no demo plays");
  if (state_ == State::kPlaying && !playing) stop();
}

void DemoCapture::add(uvec2 size, std::vector<std::uint32_t> pixels) {
  if (state_ != State::kPlaying) return;
  if (!film_) {
    size_ = size;
    auto film = lab::open_film({path_, sound_.records() ? sound_path() : "", fps_, false}, size);
    if (!film) return give_up(film.error().message);
    film_ = std::move(*film);
  }
  if (size != size_) {
    log_warning("capturedemo: the picture's size has changed: the film ends here");
    return stop();
  }
  if (auto status = film_->add({size, std::move(pixels)}); !status) give_up(status.error().message);
}

void DemoCapture::stop() {
  if (!active()) return;
  if (!film_) return give_up("no frame was drawn");
  Status sound = sound_.end_recording();
  if (!sound) return give_up(sound.error().message);
  const auto film = std::exchange(film_, nullptr)->finish();
  if (!film) return give_up(film.error().message);
  log_info("capturedemo: {}", *film);
  state_ = State::kNone;
  std::error_code ignored;
  std::filesystem::remove(sound_path(), ignored);
}

void DemoCapture::give_up(const std::string& why) {
  state_ = State::kNone;
  film_.reset();
  (void)sound_.end_recording();
  std::error_code ignored;
  std::filesystem::remove(sound_path(), ignored);
  console_.fail(fmt::format("capturedemo: {}: nothing was saved", why));
}

}  // namespace fb::host
