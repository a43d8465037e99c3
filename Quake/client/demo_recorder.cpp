#include "client/demo_recorder.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "base/log.h"
#include "formats/dem.h"
#include "fs/held_file.h"
#include "net/server_messages.h"

namespace fb::cl {
namespace {

namespace stdfs = std::filesystem;

// No message is shorter.
constexpr std::uint8_t kGoodbye[] = {net::svc::Disconnect::kCommand.number};

stdfs::path part_path(const stdfs::path& path) {
  stdfs::path part = path;
  part += ".part";
  return part;
}

// "x.dem" -> "x_cut1.dem": the first that is free. A demo that breaks off plays as far as it goes.
stdfs::path free_path(const stdfs::path& path) {
  std::error_code ignored;
  for (int i = 1;; ++i) {
    stdfs::path candidate = path;
    candidate.replace_filename(fmt::format("{}_cut{}{}", path.stem().string(), i, path.extension().string()));
    if (!stdfs::exists(candidate, ignored)) return candidate;
  }
}

}  // namespace

struct DemoRecorder::File {
  stdfs::path path;
  fs::HeldFile part;

  std::uint64_t last = 0, whole = 0;  // bytes: before the last message that was written whole, and with it
  vec3 view_angles{0.0f};             // of the last message

  // Each message at once: a program that ends badly leaves what it has.
  Status write(ByteView data) {
    if (auto status = part.append(data); !status.ok()) return status;
    last = std::exchange(whole, whole + data.size());
    return ok_status();
  }
};

DemoRecorder::DemoRecorder(std::unique_ptr<File> file) : file_(std::move(file)) {}
DemoRecorder::DemoRecorder(DemoRecorder&&) noexcept = default;
DemoRecorder& DemoRecorder::operator=(DemoRecorder&&) noexcept = default;
DemoRecorder::~DemoRecorder() = default;
const stdfs::path& DemoRecorder::path() const { return file_->path; }

Result<DemoRecorder> DemoRecorder::start(const stdfs::path& path, int track) {
  std::error_code failed;
  stdfs::create_directories(path.parent_path(), failed);
  if (failed) return Error{fmt::format("{}: its directory cannot be made: {}", path.string(), failed.message())};
  const stdfs::path part = part_path(path);
  auto held = fs::HeldFile::take(part);
  if (!held) return held.error();
  if (held->size() > 0) {
    const stdfs::path kept = free_path(path);
    stdfs::rename(part, kept, failed);
    if (failed) return Error{fmt::format("{}: left by a recording that was cut short, and in the way", part.string())};
    log_info("A recording that was cut short is now {}.", kept.string());
    held = fs::HeldFile::take(part);
    if (!held) return held.error();
  }
  auto file = std::make_unique<File>(File{path, *std::move(held)});
  const std::string line = fmt::format("{}\n", track);
  if (auto status = file->write({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}); !status.ok())
    return status.error();
  return DemoRecorder(std::move(file));
}

Status DemoRecorder::add(const vec3& view_angles, ByteView message) {
  Bytes bytes;
  formats::append_dem_message(bytes, view_angles, message);
  file_->view_angles = view_angles;
  return file_->write(bytes);
}

Status DemoRecorder::finish(const vec3& view_angles) {
  if (auto status = add(view_angles, kGoodbye); !status.ok()) return status;
  if (auto status = file_->part.flush(); !status.ok()) return status;
  std::error_code failed;
  stdfs::rename(part_path(file_->path), file_->path, failed);
  if (failed) return Error{fmt::format("{}: {}", file_->path.string(), failed.message())};
  fs::flush_path(file_->path.parent_path());
  return ok_status();
}

Result<stdfs::path> DemoRecorder::cut_short() {
  File& file = *file_;
  if (file.last == 0) return Error{fmt::format("{}: no message is whole", part_path(file.path).string())};
  const stdfs::path part = part_path(file.path);
  if (auto status = file.part.cut(file.last); !status.ok()) return status.error();
  if (auto status = add(file.view_angles, kGoodbye); !status.ok()) return status.error();
  (void)file.part.flush();
  std::error_code failed;
  const stdfs::path name = stdfs::exists(file.path, failed) ? free_path(file.path) : file.path;
  stdfs::rename(part, name, failed);
  if (failed) return Error{fmt::format("{}: {}", name.string(), failed.message())};
  return name;
}

}  // namespace fb::cl
