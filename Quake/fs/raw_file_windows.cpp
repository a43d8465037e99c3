#include <windows.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "fs/raw_file.h"
#include "fs/temporary_file.h"

namespace fb::fs {
namespace {

constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
// Which MinGW's headers know for later releases of Windows 10 alone.
constexpr auto kRenameInfoEx = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);
constexpr DWORD kReplaceLikePosix = 0x1 | 0x2;  // FILE_RENAME_FLAG_REPLACE_IF_EXISTS, FILE_RENAME_FLAG_POSIX_SEMANTICS
constexpr int kTries = 100;  // each is lost only to a program that replaces the same file at this moment

HANDLE as_handle(std::intptr_t handle) { return reinterpret_cast<HANDLE>(handle); }

class Mapping {
 public:
  explicit Mapping(const void* address) : address_(address) {}
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { UnmapViewOfFile(address_); }

 private:
  const void* address_;
};

// Windows 10 has it since version 1709, Wine 8 has not.
bool rename_like_posix(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(to, failed);
  HANDLE file =
      CreateFileW(from.c_str(), DELETE, kShare, nullptr, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (file == INVALID_HANDLE_VALUE) return false;
  const std::size_t bytes = whole.native().size() * sizeof(wchar_t);
  std::vector<char> room(sizeof(FILE_RENAME_INFO) + bytes);
  auto& info = *reinterpret_cast<FILE_RENAME_INFO*>(room.data());
  std::memcpy(&info, &kReplaceLikePosix, sizeof kReplaceLikePosix);  // its first field, which has several names
  info.FileNameLength = static_cast<DWORD>(bytes);
  std::memcpy(info.FileName, whole.c_str(), bytes);
  const bool done =
      !failed && SetFileInformationByHandle(file, kRenameInfoEx, &info, static_cast<DWORD>(room.size())) != 0;
  CloseHandle(file);
  return done;
}

}  // namespace

std::string last_failure() { return std::system_category().message(static_cast<int>(GetLastError())); }

OpenedFile open_to_read(const std::filesystem::path& path) {
  // FILE_FLAG_BACKUP_SEMANTICS: a folder opens, too, so that it is told from what may not be read.
  HANDLE handle =
      CreateFileW(path.c_str(), GENERIC_READ, kShare, nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return {};
  OpenedFile file{reinterpret_cast<std::intptr_t>(handle)};
  BY_HANDLE_FILE_INFORMATION facts{};
  file.regular = GetFileType(handle) == FILE_TYPE_DISK && GetFileInformationByHandle(handle, &facts) &&
                 (facts.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
  file.size = size_of(file.handle);
  return file;
}

void close_handle(std::intptr_t handle) { CloseHandle(as_handle(handle)); }

std::uint64_t size_of(std::intptr_t handle) {
  LARGE_INTEGER size;
  return GetFileSizeEx(as_handle(handle), &size) ? static_cast<std::uint64_t>(size.QuadPart) : 0;
}

std::optional<std::size_t> read_some(std::intptr_t handle, std::uint64_t offset, std::span<std::uint8_t> into) {
  OVERLAPPED where{};
  where.Offset = static_cast<DWORD>(offset);
  where.OffsetHigh = static_cast<DWORD>(offset >> 32u);
  DWORD got = 0;
  const DWORD wanted = static_cast<DWORD>(std::min<std::size_t>(into.size(), 1u << 30u));
  if (!ReadFile(as_handle(handle), into.data(), wanted, &got, &where) && GetLastError() != ERROR_HANDLE_EOF)
    return std::nullopt;
  return got;
}

std::optional<FileData> map_part(std::intptr_t handle, std::uint64_t offset, std::size_t size) {
  SYSTEM_INFO system;
  GetSystemInfo(&system);
  const auto before = static_cast<std::size_t>(offset % system.dwAllocationGranularity);
  const std::uint64_t start = offset - before;
  HANDLE section = CreateFileMappingW(as_handle(handle), nullptr, PAGE_READONLY, 0, 0, nullptr);
  if (section == nullptr) return std::nullopt;
  const void* const address =
      MapViewOfFile(section, FILE_MAP_READ, static_cast<DWORD>(start >> 32u), static_cast<DWORD>(start), before + size);
  CloseHandle(section);  // the view keeps it
  if (address == nullptr) return std::nullopt;
  auto mapping = std::make_shared<const Mapping>(address);
  return FileData({static_cast<const std::uint8_t*>(address) + before, size}, std::move(mapping));
}

std::error_code rename_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (rename_like_posix(from, to)) return {};
  std::error_code failed;
  for (int i = 0; i < kTries; ++i) {
    std::filesystem::rename(from, to, failed);
    if (!failed) return failed;
    // What is open keeps its name, and may be given another.
    std::error_code none;
    if (std::filesystem::is_directory(to, none)) return failed;
    const std::filesystem::path former = to.parent_path() / temporary_name();
    std::filesystem::rename(to, former, none);
    if (none) continue;
    std::filesystem::rename(from, to, failed);
    if (failed && !std::filesystem::exists(to, none))
      std::filesystem::rename(former, to, none);
    else
      std::filesystem::remove(former, none);  // gone once it is closed
    if (!failed) return failed;
  }
  return failed;
}

bool exchange_names(const std::filesystem::path&, const std::filesystem::path&) { return false; }

}  // namespace fb::fs
