// What flock is elsewhere is here a lock of one byte that no file has (LockFileEx keeps others from reading and writing
// what is locked), for a folder a mutex that is called by the folder's number. The system ends both with their process.
// A mutex is seen by programs of the same machine alone, so that two machines may hold a shared folder at once.
#include <windows.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "fs/held_file.h"

namespace fb::fs {
namespace {

constexpr int kTries = 100;  // each is lost only to a program that removes or renames the file at this moment
constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;  // a held file may be renamed
constexpr DWORD kLockHigh = 0x7fffffff;  // the locked byte's offset, upper half

enum class Lock { kOurs, kTheirs, kNone };

HANDLE as_handle(std::intptr_t handle) { return reinterpret_cast<HANDLE>(handle); }

Lock try_lock(HANDLE file) {
  OVERLAPPED where{};
  where.OffsetHigh = kLockHigh;
  if (LockFileEx(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &where)) return Lock::kOurs;
  const DWORD why = GetLastError();
  return why == ERROR_LOCK_VIOLATION || why == ERROR_IO_PENDING ? Lock::kTheirs : Lock::kNone;
}

std::string message_of(DWORD code) { return std::system_category().message(static_cast<int>(code)); }

Error cannot_be_written(const std::string& called, DWORD code) {
  return Error{fmt::format("{}: cannot be written: {}", called, message_of(code))};
}

HANDLE open_folder(const std::filesystem::path& path) {
  return CreateFileW(path.c_str(), FILE_READ_ATTRIBUTES, kShare, nullptr, OPEN_EXISTING,
                     FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
}

// The mutex of the folder; null if somebody has it, or if there is no such folder.
HANDLE folder_mutex(const std::filesystem::path& path) {
  BY_HANDLE_FILE_INFORMATION facts{};
  HANDLE folder = open_folder(path);
  const bool known = folder != INVALID_HANDLE_VALUE && GetFileInformationByHandle(folder, &facts) &&
                     (facts.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  if (folder != INVALID_HANDLE_VALUE) CloseHandle(folder);
  if (!known) {
    SetLastError(ERROR_DIRECTORY);
    return nullptr;
  }
  const std::string name = fmt::format("Global\\fullbright-folder-{:08x}-{:08x}{:08x}", facts.dwVolumeSerialNumber,
                                       facts.nFileIndexHigh, facts.nFileIndexLow);
  HANDLE mutex = CreateMutexA(nullptr, FALSE, name.c_str());
  if (mutex != nullptr && GetLastError() == ERROR_ALREADY_EXISTS) {
    CloseHandle(mutex);
    SetLastError(ERROR_ALREADY_EXISTS);
    return nullptr;
  }
  return mutex;
}

}  // namespace

Error HeldFile::failure() const { return cannot_be_written(called_, GetLastError()); }

// Whether the name is still this file's: between opening and locking it may have been removed or renamed.
bool HeldFile::stands_there() const {
  BY_HANDLE_FILE_INFORMATION ours{}, theirs{};
  HANDLE there = CreateFileW(path_.c_str(), FILE_READ_ATTRIBUTES, kShare, nullptr, OPEN_EXISTING,
                             FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (there == INVALID_HANDLE_VALUE) return false;
  const bool known =
      GetFileInformationByHandle(as_handle(handle_), &ours) && GetFileInformationByHandle(there, &theirs);
  CloseHandle(there);
  return known && ours.dwVolumeSerialNumber == theirs.dwVolumeSerialNumber &&
         ours.nFileIndexHigh == theirs.nFileIndexHigh && ours.nFileIndexLow == theirs.nFileIndexLow;
}

Result<HeldFile> HeldFile::create(const std::function<std::filesystem::path()>& name, const std::string& called) {
  for (int i = 0; i < kTries; ++i) {
    const std::filesystem::path path = name();
    HANDLE handle = CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, kShare, nullptr, CREATE_NEW,
                                FILE_ATTRIBUTE_NORMAL, nullptr);
    HeldFile file(path, called, reinterpret_cast<std::intptr_t>(handle));
    if (handle == INVALID_HANDLE_VALUE) return file.failure();
    if (try_lock(handle) != Lock::kTheirs && file.stands_there()) return file;
    // Somebody took it for left over before it was locked, and removes it by its name: the next file has another.
  }
  return cannot_be_written(called, ERROR_BUSY);
}

Result<HeldFile> HeldFile::take(const std::filesystem::path& path) {
  const std::string called = path.generic_string();
  for (int i = 0; i < kTries; ++i) {
    HANDLE handle =
        CreateFileW(path.c_str(), GENERIC_WRITE, kShare, nullptr, OPEN_ALWAYS, FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
    HeldFile file(path, called, reinterpret_cast<std::intptr_t>(handle));
    if (handle == INVALID_HANDLE_VALUE) return file.failure();
    BY_HANDLE_FILE_INFORMATION facts{};
    const DWORD type = GetFileType(handle);
    if (type == FILE_TYPE_CHAR) return file;  // NUL, CON
    if (type != FILE_TYPE_DISK || !GetFileInformationByHandle(handle, &facts) ||
        (facts.dwFileAttributes & (FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_REPARSE_POINT)) != 0)
      return Error{fmt::format("{}: cannot be written: it is neither a file nor a directory", called)};
    if (facts.nNumberOfLinks > 1) {
      // Its other name is perhaps outside, where this program has nothing to write: a new file takes this one's place.
      DeleteFileW(path.c_str());
      continue;
    }
    if (try_lock(handle) == Lock::kTheirs) return Error{fmt::format("{}: another program is writing it", called)};
    if (file.stands_there()) return file;
  }
  return cannot_be_written(called, ERROR_BUSY);
}

Result<HeldFile> HeldFile::take_folder(const std::filesystem::path& path) {
  const std::string called = path.generic_string();
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (failed) return Error{fmt::format("{}: cannot be made: {}", called, failed.message())};
  HANDLE mutex = folder_mutex(path);
  if (mutex != nullptr) return HeldFile(path, called, reinterpret_cast<std::intptr_t>(mutex));
  const DWORD why = GetLastError();
  if (why == ERROR_ALREADY_EXISTS) return Error{fmt::format("{}: another program is writing it", called)};
  return cannot_be_written(called, why);
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
  if (handle_ != -1) CloseHandle(as_handle(handle_));
}

std::uint64_t HeldFile::size() const {
  LARGE_INTEGER size;
  return GetFileSizeEx(as_handle(handle_), &size) ? static_cast<std::uint64_t>(size.QuadPart) : 0;
}

// By the handle's own position, for a device or a pipe has no other.
Status HeldFile::append(ByteView data) const {
  SetFilePointerEx(as_handle(handle_), LARGE_INTEGER{}, nullptr, FILE_END);
  while (!data.empty()) {
    DWORD written = 0;
    const DWORD wanted = static_cast<DWORD>(std::min<std::size_t>(data.size(), 1u << 30u));
    if (!WriteFile(as_handle(handle_), data.data(), wanted, &written, nullptr) || written == 0) return failure();
    data = data.subspan(written);
  }
  return ok_status();
}

Status HeldFile::write_at(std::uint64_t offset, ByteView data) const {
  while (!data.empty()) {
    OVERLAPPED where{};
    where.Offset = static_cast<DWORD>(offset);
    where.OffsetHigh = static_cast<DWORD>(offset >> 32u);
    DWORD written = 0;
    const DWORD wanted = static_cast<DWORD>(std::min<std::size_t>(data.size(), 1u << 30u));
    if (!WriteFile(as_handle(handle_), data.data(), wanted, &written, &where) || written == 0) return failure();
    offset += written;
    data = data.subspan(written);
  }
  return ok_status();
}

Status HeldFile::cut(std::uint64_t size) const {
  if (GetFileType(as_handle(handle_)) != FILE_TYPE_DISK) return ok_status();
  LARGE_INTEGER end;
  end.QuadPart = static_cast<LONGLONG>(size);
  return SetFilePointerEx(as_handle(handle_), end, nullptr, FILE_BEGIN) && SetEndOfFile(as_handle(handle_))
             ? ok_status()
             : Status(failure());
}

Status HeldFile::flush() const { return FlushFileBuffers(as_handle(handle_)) ? ok_status() : Status(failure()); }

// A new file inherits its folder's permissions here.
void HeldFile::resemble(const std::filesystem::path&) const {}

void remove_unless_held(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto type = std::filesystem::symlink_status(path, ignored).type();
  if (type == std::filesystem::file_type::directory) {
    HANDLE mutex = folder_mutex(path);
    if (mutex == nullptr) return;
    std::filesystem::remove_all(path, ignored);
    CloseHandle(mutex);
    return;
  }
  if (type != std::filesystem::file_type::regular) return;
  HANDLE handle = CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, kShare, nullptr, OPEN_EXISTING,
                              FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return;
  if (try_lock(handle) == Lock::kOurs) DeleteFileW(path.c_str());
  CloseHandle(handle);
}

// Folders need no flush here.
void flush_path(const std::filesystem::path& path) {
  HANDLE handle =
      CreateFileW(path.c_str(), GENERIC_WRITE, kShare, nullptr, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return;
  FlushFileBuffers(handle);
  CloseHandle(handle);
}

// That needs an administrator's rights: the files are flushed one by one.
void flush_file_system(const std::filesystem::path& folder) {
  std::error_code code;
  for (std::filesystem::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    if (it->is_regular_file(code)) flush_path(it->path());
}

}  // namespace fb::fs
