#include <windows.h>
// Below it, since they need its types.
#include <io.h>
#include <shellapi.h>

#include <string_view>

#include "base/system.h"

namespace fb {
namespace {

std::string utf8_of(std::wstring_view wide) {
  const int length = static_cast<int>(wide.size());
  std::string text(
      static_cast<std::size_t>(WideCharToMultiByte(CP_UTF8, 0, wide.data(), length, nullptr, 0, nullptr, nullptr)),
      '\0');
  WideCharToMultiByte(CP_UTF8, 0, wide.data(), length, text.data(), static_cast<int>(text.size()), nullptr, nullptr);
  return text;
}

}  // namespace

std::vector<std::string> program_arguments(int argc, char** argv) {
  SetConsoleOutputCP(CP_UTF8);
  int count = 0;
  wchar_t** const wide = CommandLineToArgvW(GetCommandLineW(), &count);
  if (wide == nullptr) return {argv, argv + argc};
  std::vector<std::string> arguments;
  for (int i = 0; i < count; ++i) arguments.push_back(utf8_of(wide[i]));
  LocalFree(wide);
  return arguments;
}

std::uint64_t physical_memory() {
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  return GlobalMemoryStatusEx(&memory) ? memory.ullTotalPhys : std::uint64_t{4} << 30;
}

bool has_room(std::size_t bytes) {
  void* const room = VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
  if (room == nullptr) return false;
  VirtualFree(room, 0, MEM_RELEASE);
  return true;
}

unsigned long process_number() { return GetCurrentProcessId(); }

bool is_terminal(std::FILE* file) { return _isatty(_fileno(file)) != 0; }

std::optional<std::tm> calendar_time(std::time_t time, Zone zone) {
  std::tm parts{};
  if ((zone == Zone::kLocal ? localtime_s(&parts, &time) : gmtime_s(&parts, &time)) != 0) return std::nullopt;
  return parts;
}

}  // namespace fb
