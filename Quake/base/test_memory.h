// For tests: memory use of this process.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace fb {

// Resident bytes, including pages of mapped files; 0 if the system does not report them.
inline std::uint64_t resident_bytes() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace fb
