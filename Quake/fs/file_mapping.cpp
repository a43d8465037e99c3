#include "fs/file_mapping.h"

#ifndef _WIN32
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#endif

namespace fb::fs {

#ifdef _WIN32

std::optional<FileData> map_part(std::intptr_t, std::uint64_t, std::size_t) { return std::nullopt; }

#else

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

std::optional<FileData> map_part(std::intptr_t handle, std::uint64_t offset, std::size_t size) {
  const std::uint64_t page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const auto before = static_cast<std::size_t>(offset % page);  // mappings begin at pages
  void* const address = ::mmap(nullptr, before + size, PROT_READ, MAP_PRIVATE, static_cast<int>(handle),
                               static_cast<off_t>(offset - before));
  if (address == MAP_FAILED) return std::nullopt;
  auto mapping = std::make_shared<const Mapping>(address, before + size);
  return FileData({static_cast<const std::uint8_t*>(address) + before, size}, std::move(mapping));
}

#endif

}  // namespace fb::fs
