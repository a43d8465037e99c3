#include "host/game/screenshot_name.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace fb::host {

std::string free_screenshot_name(const fs::FileSystem& files) {
  for (int number = 0;; ++number) {
    std::string name = fmt::format("fullbright{:04}.png", number);
    const auto path = files.write_path("screenshots/" + name);
    std::error_code ignored;
    if (!path || !std::filesystem::exists(*path, ignored)) return name;  // writing says what is wrong with the path
  }
}

std::string typed_screenshot_name(const std::string& name) { return name.ends_with(".png") ? name : name + ".png"; }

}  // namespace fb::host
