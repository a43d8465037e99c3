#include "host/build_text.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "base/hash.h"
#include "fs/file.h"

namespace fb::host {

std::string build_text() {
#ifdef NDEBUG
  std::string text = "optimised";
#else
  std::string text = "with checks";
#endif
#ifdef __VERSION__
  text += ", compiler " __VERSION__;
#endif
  std::error_code none;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", none);
  if (none) return text;
  const auto bytes = fs::read_whole_file(path);
  return bytes ? text + fmt::format(", program {:016x}", hash_bytes(bytes->data(), bytes->size())) : text;
}

}  // namespace fb::host
