// Where the running program lies.
#pragma once

#include <filesystem>

namespace fb::platform {

// The folder of the program's file, links resolved; empty where the system does not say.
std::filesystem::path program_directory();

}  // namespace fb::platform
