// Nothing here says of a console whether a line can be read without waiting, so a thread of its own waits. It ends with
// the program: nobody can wake it.
#include <windows.h>
// Below it, since it needs its types.
#include <io.h>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "host/game/terminal.h"

namespace fb::host {
namespace {

struct Typed {
  std::mutex mutex;
  std::string bytes;
  bool ended = false;
};

// What has been read of a console, in UTF-8, or of a pipe or a file; empty at its end.
std::string read_waiting(HANDLE file) {
  DWORD mode = 0, count = 0;
  if (GetConsoleMode(file, &mode)) {
    std::array<wchar_t, 4096> wide{};
    if (!ReadConsoleW(file, wide.data(), static_cast<DWORD>(wide.size()), &count, nullptr)) return {};
    std::string text(4 * count, '\0');
    text.resize(
        static_cast<std::size_t>(WideCharToMultiByte(CP_UTF8, 0, wide.data(), static_cast<int>(count), text.data(),
                                                     static_cast<int>(text.size()), nullptr, nullptr)));
    return text;
  }
  std::string bytes(4096, '\0');
  if (!ReadFile(file, bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr)) count = 0;
  bytes.resize(count);
  return bytes;
}

// One for each descriptor, for as long as the program runs.
Typed& reader_of(int descriptor) {
  static std::mutex mutex;
  static auto& readers = *new std::map<int, std::unique_ptr<Typed>>;  // its threads outlive static objects
  const std::lock_guard lock(mutex);
  std::unique_ptr<Typed>& typed = readers[descriptor];
  if (!typed) {
    typed = std::make_unique<Typed>();
    std::thread([descriptor, &into = *typed] {
      const auto file = reinterpret_cast<HANDLE>(_get_osfhandle(descriptor));
      for (bool more = file != INVALID_HANDLE_VALUE; more;) {
        const std::string bytes = read_waiting(file);
        more = !bytes.empty();
        const std::lock_guard filling(into.mutex);
        into.bytes += bytes;
      }
      const std::lock_guard filling(into.mutex);
      into.ended = true;
    }).detach();
  }
  return *typed;
}

}  // namespace

bool TerminalLines::read_more() {
  if (ended_) return false;
  Typed& typed = reader_of(file_);
  const std::lock_guard lock(typed.mutex);
  if (typed.bytes.empty()) {
    ended_ = typed.ended;
    return false;
  }
  for (const char c : typed.bytes)
    if (c != '\r') text_ += c;
  typed.bytes.clear();
  return true;
}

}  // namespace fb::host
