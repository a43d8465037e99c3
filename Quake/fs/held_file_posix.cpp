#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "fs/held_file.h"

namespace fb::fs {
namespace {

constexpr int kTries = 100;  // each is lost only to a program that removes or renames the file at this moment

enum class Lock { kOurs, kTheirs, kNone };

int descriptor_of(std::intptr_t handle) { return static_cast<int>(handle); }

Lock try_lock(int handle) {
  int failed = 0;
  do failed = ::flock(handle, LOCK_EX | LOCK_NB);
  while (failed != 0 && errno == EINTR);
  if (failed == 0) return Lock::kOurs;
  return errno == EWOULDBLOCK ? Lock::kTheirs : Lock::kNone;
}

Error cannot_be_written(const std::string& called, int code) {
  return Error{fmt::format("{}: cannot be written: {}", called, std::generic_category().message(code))};
}

}  // namespace

Error HeldFile::failure() const { return cannot_be_written(called_, errno); }

// Whether the name is still this file's: between opening and locking it may have been removed or renamed.
bool HeldFile::stands_there() const {
  struct stat ours {
  }, theirs{};
  return ::fstat(descriptor_of(handle_), &ours) == 0 && ::lstat(path_.c_str(), &theirs) == 0 &&
         ours.st_ino == theirs.st_ino && ours.st_dev == theirs.st_dev;
}

Result<HeldFile> HeldFile::create(const std::function<std::filesystem::path()>& name, const std::string& called) {
  for (int i = 0; i < kTries; ++i) {
    const std::filesystem::path path = name();
    HeldFile file(path, called, ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    if (file.handle_ < 0) return file.failure();
    if (try_lock(descriptor_of(file.handle_)) != Lock::kTheirs && file.stands_there()) return file;
    // Somebody took it for left over before it was locked, and removes it by its name: the next file has another.
  }
  return cannot_be_written(called, EBUSY);
}

Result<HeldFile> HeldFile::take(const std::filesystem::path& path) {
  // O_NONBLOCK: a FIFO must not stop the program.
  return take(path, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
}

Result<HeldFile> HeldFile::take_folder(const std::filesystem::path& path) {
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (failed) return Error{fmt::format("{}: cannot be made: {}", path.generic_string(), failed.message())};
  return take(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

Result<HeldFile> HeldFile::take(const std::filesystem::path& path, int flags) {
  const std::string called = path.generic_string();
  for (int i = 0; i < kTries; ++i) {
    HeldFile file(path, called, ::open(path.c_str(), flags, 0666));
    struct stat facts {};
    if (file.handle_ < 0 || ::fstat(descriptor_of(file.handle_), &facts) != 0) return file.failure();
    if (S_ISCHR(facts.st_mode)) return file;
    if (!S_ISREG(facts.st_mode) && !S_ISDIR(facts.st_mode))
      return Error{fmt::format("{}: cannot be written: it is neither a file nor a directory", called)};
    if (S_ISREG(facts.st_mode) && facts.st_nlink > 1) {
      // Its other name is perhaps outside, where this program has nothing to write: a new file takes this one's place.
      ::unlink(path.c_str());
      continue;
    }
    if (try_lock(descriptor_of(file.handle_)) == Lock::kTheirs)
      return Error{fmt::format("{}: another program is writing it", called)};
    if (file.stands_there()) return file;
  }
  return cannot_be_written(called, EBUSY);
}

HeldFile::HeldFile(HeldFile&& other) noexcept
    : path_(std::move(other.path_)), called_(std::move(other.called_)), handle_(std::exchange(other.handle_, -1)) {}

HeldFile& HeldFile::operator=(HeldFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(called_, other.called_);
  std::swap(handle_, other.handle_);
  return *this;
}

HeldFile::~HeldFile() {
  if (handle_ >= 0) ::close(descriptor_of(handle_));
}

std::uint64_t HeldFile::size() const {
  struct stat facts {};
  return ::fstat(descriptor_of(handle_), &facts) == 0 ? static_cast<std::uint64_t>(facts.st_size) : 0;
}

// By the handle's own position, for a device or a pipe has no other.
Status HeldFile::append(ByteView data) const {
  (void)::lseek(descriptor_of(handle_), 0, SEEK_END);
  while (!data.empty()) {
    const ssize_t written = ::write(descriptor_of(handle_), data.data(), data.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return failure();
    data = data.subspan(static_cast<std::size_t>(written));
  }
  return ok_status();
}

Status HeldFile::write_at(std::uint64_t offset, ByteView data) const {
  while (!data.empty()) {
    const ssize_t written = ::pwrite(descriptor_of(handle_), data.data(), data.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return failure();
    offset += static_cast<std::uint64_t>(written);
    data = data.subspan(static_cast<std::size_t>(written));
  }
  return ok_status();
}

Status HeldFile::cut(std::uint64_t size) const {
  struct stat facts {};
  if (::fstat(descriptor_of(handle_), &facts) == 0 && !S_ISREG(facts.st_mode)) return ok_status();
  return ::ftruncate(descriptor_of(handle_), static_cast<off_t>(size)) == 0 ? ok_status() : Status(failure());
}

Status HeldFile::flush() const { return ::fsync(descriptor_of(handle_)) == 0 ? ok_status() : Status(failure()); }

void HeldFile::resemble(const std::filesystem::path& former) const {
  struct stat facts {};
  if (::lstat(former.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return;
  (void)!::fchmod(descriptor_of(handle_), facts.st_mode & 0777u);
}

void remove_unless_held(const std::filesystem::path& path) {
  // To write, since a network's file system locks no file for writing that is open for reading alone.
  int handle = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) handle = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return;
  std::error_code ignored;
  if (try_lock(handle) == Lock::kOurs) std::filesystem::remove_all(path, ignored);
  ::close(handle);
}

void flush_path(const std::filesystem::path& path) {
  const int handle = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return;
  (void)::fsync(handle);
  ::close(handle);
}

void flush_file_system(const std::filesystem::path& folder) {
#ifdef __linux__
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  (void)::syncfs(handle);
  ::close(handle);
#else
  (void)folder;
  ::sync();
#endif
}

}  // namespace fb::fs
