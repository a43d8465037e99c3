#include <sys/mman.h>
#include <unistd.h>

#include "base/system.h"

namespace fb {

std::vector<std::string> program_arguments(int argc, char** argv) { return {argv, argv + argc}; }

std::uint64_t physical_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page > 0) return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  return std::uint64_t{4} << 30;
}

bool has_room(std::size_t bytes) {
  void* const room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return false;
  ::munmap(room, bytes);
  return true;
}

unsigned long process_number() { return static_cast<unsigned long>(::getpid()); }

bool is_terminal(std::FILE* file) { return ::isatty(::fileno(file)) != 0; }

std::optional<std::tm> calendar_time(std::time_t time, Zone zone) {
  std::tm parts{};
  if ((zone == Zone::kLocal ? ::localtime_r(&time, &parts) : ::gmtime_r(&time, &parts)) == nullptr) return std::nullopt;
  return parts;
}

}  // namespace fb
