#include "host/game/mod_list.h"

#include <algorithm>
#include <map>
#include <string>
#include <system_error>

#include "base/text_mark.h"
#include "fs/file.h"
#include "fs/mod_install.h"
#include "host/game/server_list.h"

namespace fb::host {
namespace {

namespace stdfs = std::filesystem;

constexpr std::uintmax_t kMostDescription = 64 * 1024;  // bytes; what is longer is none

std::string description_of(const stdfs::path& folder) {
  for (const char* name : {"modinfo.txt", "description.txt"}) {
    std::error_code code;
    const stdfs::path path = folder / name;
    if (!stdfs::is_regular_file(path, code) || stdfs::file_size(path, code) > kMostDescription) continue;
    const auto data = fs::read_whole_file(path);
    if (!data) continue;
    const std::string_view text = without_byte_order_mark(data->text());
    const std::size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    std::string line = plain_text(text.substr(start, text.find_first_of("\r\n", start) - start));
    if (!line.empty()) return line;
  }
  return {};
}

}  // namespace

std::vector<ui::menu::ModEntry> list_mods(const fs::FileSystem& files) {
  std::map<std::string, std::string> found;  // description by folder
  const fs::FsOptions& options = files.options();
  const stdfs::path user = options.user_dir ? *options.user_dir : fs::default_user_dir();
  for (const stdfs::path& place : {options.base_dir, user}) {
    std::error_code code;
    if (place.empty()) continue;
    for (stdfs::directory_iterator it(place, code), end; !code && it != end; it.increment(code)) {
      std::error_code ignored;
      const std::string name = it->path().filename().string();
      // With a dot first: what is being installed.
      if (!it->is_directory(ignored) || name.starts_with('.') || name == "archives") continue;
      if (name != "id1" && !fs::holds_game_data(it->path())) continue;
      std::string& description = found[name];
      if (description.empty()) description = description_of(it->path());
    }
  }
  std::vector<ui::menu::ModEntry> mods;
  for (auto& [name, description] : found) mods.push_back({name, std::move(description), name == files.game()});
  std::stable_partition(mods.begin(), mods.end(), [](const ui::menu::ModEntry& mod) { return mod.directory == "id1"; });
  return mods;
}

}  // namespace fb::host
