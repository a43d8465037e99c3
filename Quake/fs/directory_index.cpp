#include "fs/directory_index.h"

#include <algorithm>
#include <system_error>

#include "fs/path.h"

namespace fb::fs {

const DirectoryIndex::Listing* DirectoryIndex::listing(const std::filesystem::path& directory) {
  std::error_code code;
  const auto changed = std::filesystem::last_write_time(directory, code);
  const std::string key = directory.string();
  if (code) {
    listings_.erase(key);
    return nullptr;
  }
  const auto known = listings_.find(key);
  if (known != listings_.end() && known->second.changed == changed) return &known->second;

  Listing fresh;
  fresh.changed = changed;
  for (std::filesystem::directory_iterator it(directory, code), end; !code && it != end; it.increment(code)) {
    const std::string real = it->path().filename().string();
    auto [place, added] = fresh.names.emplace(lower_case(real), real);
    if (!added) place->second = std::min(place->second, real);
  }
  return &(listings_[key] = std::move(fresh));
}

std::optional<std::string> DirectoryIndex::find(const std::filesystem::path& root, std::string_view name) {
  std::lock_guard lock(mutex_);
  std::string real;
  std::filesystem::path directory = root;
  std::size_t start = 0;
  while (start < name.size()) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    const Listing* here = listing(directory);
    if (here == nullptr) return std::nullopt;
    const auto found = here->names.find(lower_case(name.substr(start, end - start)));
    if (found == here->names.end()) return std::nullopt;
    if (!real.empty()) real += '/';
    real += found->second;
    directory /= found->second;
    start = end + 1;
  }
  return real;
}

}  // namespace fb::fs
