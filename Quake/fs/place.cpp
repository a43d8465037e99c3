#include "fs/place.h"

#include <cstdint>
#include <system_error>

#include "fs/path.h"

namespace fb::fs {
namespace {

constexpr int kMaxDepth = 16;  // depth of directories below a gamedir; links may form loops

void add_below(const std::filesystem::path& directory, const std::string& below, const Place& place, int depth,
               const Pattern& pattern, ListedFiles& files) {
  std::error_code code;
  for (std::filesystem::directory_iterator it(directory, code), end; !code && it != end; it.increment(code)) {
    const std::string name = below + it->path().filename().string();
    std::error_code unreadable;
    if (it->is_directory(unreadable)) {
      if (depth < kMaxDepth && pattern.directory(name + '/'))
        add_below(it->path(), name + '/', place, depth + 1, pattern, files);
    } else if (pattern.file(name) && it->is_regular_file(unreadable)) {
      const std::uint64_t size = it->file_size(unreadable);
      files.emplace(name, FoundFile{name, place.label, unreadable ? 0 : size});
    }
  }
}

}  // namespace

bool Pattern::file(std::string_view name) const {
  return lower_case(name).starts_with(prefix) && ends_with_ignoring_case(name, extension);
}

bool Pattern::directory(std::string_view name) const {
  const std::string lower = lower_case(name);
  return lower.starts_with(prefix) || prefix.starts_with(lower);
}

void add_loose_files(const std::filesystem::path& directory, const Place& place, const Pattern& pattern,
                     ListedFiles& files) {
  add_below(directory, "", place, 0, pattern, files);
}

}  // namespace fb::fs
