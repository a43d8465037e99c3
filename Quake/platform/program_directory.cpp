#include "platform/program_directory.h"

#include <SDL_filesystem.h>
#include <SDL_stdinc.h>

#include <memory>

namespace fb::platform {

std::filesystem::path program_directory() {
  const std::unique_ptr<char, decltype(&SDL_free)> path(SDL_GetBasePath(), &SDL_free);
  return path ? std::filesystem::path(reinterpret_cast<const char8_t*>(path.get())) : std::filesystem::path();
}

}  // namespace fb::platform
