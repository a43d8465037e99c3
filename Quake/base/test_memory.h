// For tests: what this process has in memory.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace fb {

// Bytes that are resident, pages of mapped files among them; 0 where the system does not say.
inline std::uint64_t resident_bytes() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace fb
