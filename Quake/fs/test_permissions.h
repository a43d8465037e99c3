// For tests of unreadable files. Root can read everything, so the process becomes user nobody for a while.
#pragma once

#ifdef __unix__
#include <unistd.h>
#endif

#include <filesystem>
#include <system_error>
#include <utility>

namespace fb::fs {

// While it lives, permissions of files apply to the process. False if that was not possible.
class PermissionsCount {
 public:
#ifdef __unix__
  PermissionsCount() : was_root_(::geteuid() == 0) { count_ = !was_root_ || ::seteuid(kNobody) == 0; }
  ~PermissionsCount() {
    if (was_root_ && count_) count_ = ::seteuid(0) == 0;
  }
#else
  PermissionsCount() = default;
#endif
  PermissionsCount(const PermissionsCount&) = delete;
  PermissionsCount& operator=(const PermissionsCount&) = delete;
  explicit operator bool() const { return count_; }

 private:
  static constexpr unsigned kNobody = 65534;
  bool was_root_ = false, count_ = false;
};

// Removes permissions from a file or folder until it is destroyed, so that the test's directory can be removed.
class WithPermissions {
 public:
  WithPermissions(std::filesystem::path path, unsigned mode)
      : path_(std::move(path)), before_(std::filesystem::status(path_).permissions()) {
    std::filesystem::permissions(path_, static_cast<std::filesystem::perms>(mode));
  }
  ~WithPermissions() {
    std::error_code ignored;
    std::filesystem::permissions(path_, before_, ignored);
  }
  WithPermissions(const WithPermissions&) = delete;
  WithPermissions& operator=(const WithPermissions&) = delete;

 private:
  std::filesystem::path path_;
  std::filesystem::perms before_;
};

}  // namespace fb::fs
