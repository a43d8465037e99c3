// What the operating system is asked for itself, alike on all systems: system_posix.cpp, system_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

namespace fb {

// What main() was called with, the program's name first, in UTF-8, which Windows gives in another way. There the
// console shows UTF-8 from then on.
std::vector<std::string> program_arguments(int argc, char** argv);

// What the machine has in all, bytes; 4 GiB where the system does not say.
std::uint64_t physical_memory();
// Whether the system would give so many bytes more. Asked of it directly: an allocator may keep what it gets.
bool has_room(std::size_t bytes);

unsigned long process_number();
// Whether somebody sees what is written to the file at once.
bool is_terminal(std::FILE* file);

enum class Zone { kLocal, kGreenwich };
// Nothing for a time beyond what a calendar here holds.
std::optional<std::tm> calendar_time(std::time_t time, Zone zone);

}  // namespace fb
