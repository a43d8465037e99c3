#include "lab/film/film_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#endif

#include "base/stop.h"
#include "fs/held_file.h"
#include "lab/image_io.h"
#include "lab/judge/program.h"
#include "lab/picture.h"

namespace fb::lab {
namespace {

namespace stdfs = std::filesystem;

class FolderWriter : public FilmWriter {
 public:
  explicit FolderWriter(FilmOutput output) : output_(std::move(output)), part_(output_.path + ".part") {}
  ~FolderWriter() override {
    std::error_code ignored;
    if (held_) stdfs::remove_all(part_, ignored);
  }
  Status open() {
    std::error_code failed;
    if (stdfs::exists(output_.path, failed) &&
        !(stdfs::is_directory(output_.path, failed) && stdfs::is_empty(output_.path, failed)))
      return Error{fmt::format("{}: there is something of that name; a film wants a new folder", output_.path)};
    auto held = fs::HeldFile::take_folder(part_);
    if (!held) return held.error();
    held_ = *std::move(held);
    for (const auto& left_over : stdfs::directory_iterator(part_, failed)) stdfs::remove_all(left_over.path(), failed);
    return failed ? Status(Error{fmt::format("{}: {}", part_, failed.message())}) : ok_status();
  }
  Status add(const FilmFrame& frame) override {
    const std::string name = fmt::format("{}/frame_{:06}", part_, frames_++);
    if (!output_.exr) return write_png(name + ".png", frame.size.x, frame.size.y, frame.pixels);
    Picture shown{frame.size.x, frame.size.y, {}};
    for (const std::uint32_t p : frame.pixels)
      shown.pixels.push_back(vec3(p & 0xffu, (p >> 8u) & 0xffu, (p >> 16u) & 0xffu) / 255.0f);
    ExrImage exr(frame.size.x, frame.size.y);
    exr.add_colors("", decoded(shown).pixels);
    return write_exr(name + ".exr", exr);
  }
  Result<std::string> finish() override {
    std::error_code failed;
    if (!output_.sound.empty()) stdfs::copy_file(output_.sound, part_ + "/sound.wav", failed);
    stdfs::remove(output_.path, failed);  // an empty folder
    stdfs::rename(part_, output_.path, failed);
    if (failed) return Error{fmt::format("{}: {}", output_.path, failed.message())};
    held_.reset();
    return fmt::format("{} frames in {}", frames_, output_.path);
  }

 private:
  FilmOutput output_;
  std::string part_;
  std::optional<fs::HeldFile> held_;
  std::uint64_t frames_ = 0;
};

#ifndef _WIN32

class FfmpegWriter : public FilmWriter {
 public:
  explicit FfmpegWriter(FilmOutput output) : output_(std::move(output)), part_(output_.path + ".part") {}
  ~FfmpegWriter() override {
    if (child_ > 0) ::kill(child_, SIGKILL);
    wait();
    std::error_code ignored;
    if (held_) stdfs::remove(part_, ignored);
  }
  Status open(uvec2 size) {
    auto held = fs::HeldFile::take(part_);
    if (!held) return held.error();
    held_ = *std::move(held);
    said_.reset(std::tmpfile());
    int ends[2];
    if (!said_ || ::pipe2(ends, O_CLOEXEC) != 0)
      return Error{fmt::format("ffmpeg cannot be started: {}", std::strerror(errno))};
    std::vector<std::string> arguments{"ffmpeg",
                                       "-y",
                                       "-nostdin",
                                       "-loglevel",
                                       "error",
                                       "-f",
                                       "rawvideo",
                                       "-pix_fmt",
                                       "rgb24",
                                       "-s",
                                       fmt::format("{}x{}", size.x, size.y),
                                       "-r",
                                       fmt::format("{}", output_.fps),
                                       "-i",
                                       "pipe:0"};
    // Its chroma has half the resolution, so sides are even.
    arguments.insert(arguments.end(), {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-preset", "medium",
                                       "-crf", "16", "-pix_fmt", "yuv420p", "-f", format(), part_});
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    survive_failed_writes();  // ffmpeg may end before its input
    const pid_t parent = ::getpid();
    child_ = ::fork();
    if (child_ == 0) {
#ifdef __linux__
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) ::_exit(127);
#endif
      ::dup2(ends[0], STDIN_FILENO);
      ::dup2(::fileno(said_.get()), STDOUT_FILENO);
      ::dup2(::fileno(said_.get()), STDERR_FILENO);
      ::execvp(argv[0], argv.data());
      ::_exit(127);
    }
    ::close(ends[0]);
    pipe_ = ends[1];
    return child_ > 0 ? ok_status() : Status(Error{fmt::format("ffmpeg cannot be started: {}", std::strerror(errno))});
  }
  Status add(const FilmFrame& frame) override {
    bytes_.clear();
    for (const std::uint32_t p : frame.pixels)
      for (const unsigned shift : {0u, 8u, 16u}) bytes_.push_back(static_cast<std::uint8_t>(p >> shift));
    for (std::size_t done = 0; done < bytes_.size();) {
      const ssize_t count = ::write(pipe_, bytes_.data() + done, bytes_.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        wait();
        return failure();
      }
      done += static_cast<std::size_t>(count);
    }
    ++frames_;
    return ok_status();
  }
  Result<std::string> finish() override {
    // A full disk at the very end is an error that it prints and does not exit with.
    if (wait() != 0 || !output().empty()) return failure();
    if (auto status = add_sound(); !status) return status.error();
    std::error_code failed;
    stdfs::rename(part_, output_.path, failed);
    if (failed) return Error{fmt::format("{}: {}", output_.path, failed.message())};
    held_.reset();
    return fmt::format("{} frames in {}{}", frames_, output_.path, output_.sound.empty() ? "" : ", with sound");
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const char* format() const { return output_.path.ends_with(".mkv") ? "matroska" : "mp4"; }
  // The sound is whole only after the last frame, so it is joined then; its end is the film's.
  Status add_sound() {
    if (output_.sound.empty()) return ok_status();
    const std::string joined = output_.path + ".joined.part";
    const auto end =
        run_program({"ffmpeg",    "-y",          "-nostdin",
                     "-loglevel", "error",       "-i",
                     part_,       "-sseof",      fmt::format("-{}", static_cast<double>(frames_) / output_.fps),
                     "-i",        output_.sound, "-map",
                     "0:v",       "-map",        "1:a",
                     "-c:v",      "copy",        "-c:a",
                     "aac",       "-t",          fmt::format("{}", static_cast<double>(frames_) / output_.fps),
                     "-f",        format(),      joined});
    std::error_code failed;
    if (end && end->status == 0 && end->output.empty()) {
      stdfs::rename(joined, part_, failed);
      return failed ? Status(Error{fmt::format("{}: {}", part_, failed.message())}) : ok_status();
    }
    stdfs::remove(joined, failed);
    return end ? Error{fmt::format("{}: ffmpeg failed: {}", output_.path, end->output)} : end.error();
  }
  // ffmpeg's exit status, once its input has ended.
  int wait() {
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (child_ > 0 && ::waitpid(child_, &status, 0) < 0)
      if (errno != EINTR) break;
    child_ = -1;
    return status;
  }
  std::string output() const {
    std::string text(2000, '\0');
    std::rewind(said_.get());
    text.resize(std::fread(text.data(), 1, text.size(), said_.get()));
    std::ranges::replace(text, '\n', ' ');
    return text;
  }
  Error failure() const {
    const std::string text = output();
    return Error{fmt::format("{}: ffmpeg failed: {}", output_.path, text.empty() ? "it says nothing" : text)};
  }

  FilmOutput output_;
  std::string part_;
  std::optional<fs::HeldFile> held_;  // ffmpeg writes into the same file
  std::unique_ptr<std::FILE, Close> said_;
  pid_t child_ = -1;
  int pipe_ = -1;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t frames_ = 0;
};

#endif

}  // namespace

bool is_film_file(const std::string& path) { return path.ends_with(".mp4") || path.ends_with(".mkv"); }

bool has_ffmpeg() {
  const auto end = run_program({"ffmpeg", "-version"});
  return end && end->status == 0;
}

Result<std::unique_ptr<FilmWriter>> open_film(const FilmOutput& output, uvec2 size) {
#ifndef _WIN32
  if (is_film_file(output.path)) {
    auto writer = std::make_unique<FfmpegWriter>(output);
    if (auto status = writer->open(size); !status) return status.error();
    return Result<std::unique_ptr<FilmWriter>>(std::move(writer));
  }
#endif
  auto writer = std::make_unique<FolderWriter>(output);
  if (auto status = writer->open(); !status) return status.error();
  return Result<std::unique_ptr<FilmWriter>>(std::move(writer));
}

}  // namespace fb::lab
