#include "fs/raw_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __linux__
#include <stdio.h>
#endif

#include <cerrno>
#include <memory>

namespace fb::fs {
namespace {

class Mapping {
 public:
  Mapping(void* address, std::size_t size) : address_(address), size_(size) {}
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { ::munmap(address_, size_); }

 private:
  void* address_;
  std::size_t size_;
};

}  // namespace

std::string last_failure() { return std::generic_category().message(errno); }

OpenedFile open_to_read(const std::filesystem::path& path) {
  OpenedFile file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat facts {};
  if (file.handle == kNoHandle) return file;
  if (::fstat(static_cast<int>(file.handle), &facts) != 0) {
    const int why = errno;
    close_handle(file.handle);
    errno = why;
    return {};
  }
  file.regular = S_ISREG(facts.st_mode);
  file.size = static_cast<std::uint64_t>(facts.st_size);
  return file;
}

void close_handle(std::intptr_t handle) { ::close(static_cast<int>(handle)); }

std::uint64_t size_of(std::intptr_t handle) {
  struct stat facts {};
  return ::fstat(static_cast<int>(handle), &facts) == 0 ? static_cast<std::uint64_t>(facts.st_size) : 0;
}

std::optional<std::size_t> read_some(std::intptr_t handle, std::uint64_t offset, std::span<std::uint8_t> into) {
  for (;;) {
    const ssize_t got = ::pread(static_cast<int>(handle), into.data(), into.size(), static_cast<off_t>(offset));
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) return std::nullopt;
  }
}

std::optional<FileData> map_part(std::intptr_t handle, std::uint64_t offset, std::size_t size) {
  const std::uint64_t page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const auto before = static_cast<std::size_t>(offset % page);  // mappings begin at pages
  void* const address = ::mmap(nullptr, before + size, PROT_READ, MAP_PRIVATE, static_cast<int>(handle),
                               static_cast<off_t>(offset - before));
  if (address == MAP_FAILED) return std::nullopt;
  auto mapping = std::make_shared<const Mapping>(address, before + size);
  return FileData({static_cast<const std::uint8_t*>(address) + before, size}, std::move(mapping));
}

std::error_code rename_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code failed;
  std::filesystem::rename(from, to, failed);
  return failed;
}

bool exchange_names([[maybe_unused]] const std::filesystem::path& one,
                    [[maybe_unused]] const std::filesystem::path& other) {
#ifdef __linux__
  return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

}  // namespace fb::fs
