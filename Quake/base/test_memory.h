// For tests: what this process holds in memory and has read, for those that say something costs next to nothing. Unlike
// time it does not depend on what else the machine does.
#pragma once

#ifdef __unix__
#include <unistd.h>
#endif

#include <cstdint>
#include <fstream>
#include <string>

namespace fb {

// Resident bytes, including pages of mapped files; 0 if the system does not report them.
inline std::uint64_t resident_bytes() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
#ifdef __unix__
  resident *= static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
#endif
  return resident;
}

// Bytes that calls of read() and its kin have brought since the process began; 0 if the system does not report them.
// What is mapped counts in resident_bytes().
inline std::uint64_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string key;
  std::uint64_t value = 0;
  while (io >> key >> value)
    if (key == "rchar:") return value;
  return 0;
}

}  // namespace fb
