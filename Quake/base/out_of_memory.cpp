#include "base/out_of_memory.h"

#include <fmt/format.h>

namespace fb {

std::string sentence_of(const std::bad_alloc& failure) {
  const auto* ours = dynamic_cast<const OutOfMemory*>(&failure);
  return ours ? ours->what() : "the system has no memory left for this program";
}

std::string memory_text(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} bytes", bytes);
  double size = static_cast<double>(bytes) / 1024.0;
  for (const char* unit : {"KiB", "MiB", "GiB"}) {
    if (size < 1024.0) return fmt::format("{:.1f} {}", size, unit);
    size /= 1024.0;
  }
  return fmt::format("{:.1f} TiB", size);
}

}  // namespace fb
