// The console's lines between runs of the program: a text file of one a line, the newest last, as QuakeSpasm's
// history.txt.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace fb::con {

// The newest lines, at most InputLine::kMaxHistory; none if there is no such file. Fails if it cannot be read.
Result<std::vector<std::string>> read_history(const std::filesystem::path& path);
// Adds what was entered to what the file holds by then, so that of several programs none loses its lines; those that
// may hold a password are left out. A file that cannot be read stays as it is.
Status add_to_history(const std::filesystem::path& path, std::span<const std::string> entered);

// Whether the line names a password, in whichever command or cvar.
bool may_hold_password(std::string_view line);

}  // namespace fb::con
