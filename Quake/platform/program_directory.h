// The folder of the running program.
#pragma once

#include <filesystem>

namespace fb::platform {

// The folder of the program's file, with links resolved; empty if the system does not report it.
std::filesystem::path program_directory();

}  // namespace fb::platform
