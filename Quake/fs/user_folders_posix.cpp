#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "fs/options.h"

namespace fb::fs {

std::filesystem::path home_directory() {
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') return home;
  // A user of a service has a home there that does not exist.
  std::error_code code;
  const passwd* user = ::getpwuid(::geteuid());
  if (user != nullptr && user->pw_dir != nullptr && *user->pw_dir == '/' &&
      std::filesystem::is_directory(user->pw_dir, code))
    return user->pw_dir;
  return {};
}

std::filesystem::path default_user_dir() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return std::filesystem::path(data) / "fullbright";
  if (const std::filesystem::path home = home_directory(); !home.empty()) return home / ".fullbright";
  return {};
}

bool plays_beside_data() { return false; }

}  // namespace fb::fs
