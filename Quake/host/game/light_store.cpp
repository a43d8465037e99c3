#include "host/game/light_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "base/log.h"

namespace fb::host {
namespace {

constexpr const char* kExtension = ".fblight";

std::string name_of(std::uint64_t key) { return fmt::format("light/{:016x}{}", key, kExtension); }

// Removes the oldest files until the others are no more than so many bytes.
void trim(const std::filesystem::path& folder, std::uint64_t most) {
  struct Kept {
    std::filesystem::path path;
    std::filesystem::file_time_type time;
    std::uint64_t size;
  };
  std::vector<Kept> files;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    if (entry.path().extension() != kExtension || !entry.is_regular_file(failed)) continue;
    files.push_back({entry.path(), entry.last_write_time(failed), entry.file_size(failed)});
  }
  std::ranges::sort(files, std::ranges::greater(), &Kept::time);
  std::uint64_t sum = 0;
  for (const Kept& file : files)
    if ((sum += file.size) > most) std::filesystem::remove(file.path, failed);
}

}  // namespace

scene::AuthoredStore light_store(fs::FileSystem& files) {
  return {[&files](std::uint64_t key) -> std::optional<FileData> {
            auto data = files.read_own(name_of(key));
            return data ? std::optional(std::move(*data)) : std::nullopt;
          },
          [&files](std::uint64_t key, const Bytes& bytes) {
            const auto path = files.write_path(name_of(key));
            if (!path) return;
            if (const auto status = files.write(name_of(key), bytes, fs::Flush::kLater); !status)
              return log_warning("The map's light cannot be kept, so each start finds it anew: {}",
                                 status.error().message);
            trim(path->parent_path(), kMostKeptLight);
          },
          name_of};
}

}  // namespace fb::host
