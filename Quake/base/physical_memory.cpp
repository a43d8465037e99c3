#include "base/physical_memory.h"

#ifndef _WIN32
#include <unistd.h>
#endif

namespace fb {

std::uint64_t physical_memory() {
#ifdef _SC_PHYS_PAGES
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page > 0) return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
#endif
  return std::uint64_t{4} << 30;
}

}  // namespace fb
