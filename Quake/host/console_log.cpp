#include "host/console_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <ostream>
#include <system_error>
#include <utility>

namespace fb::host {
namespace {

std::string_view prefix(LogLevel level) {
  return level == LogLevel::kWarning ? "warning: " : level == LogLevel::kError ? "error: " : "";
}

}  // namespace

Result<std::unique_ptr<ConsoleLog>> ConsoleLog::open(const std::filesystem::path& path, std::uint64_t most_bytes) {
  std::error_code ignored;  // opening fails for the same reason
  std::filesystem::create_directories(path.parent_path(), ignored);
  auto file = std::make_shared<File>();
  file->name = path.string();
  file->room = most_bytes;
  errno = 0;
  file->stream.open(path, std::ios::binary | std::ios::trunc);
  if (!file->stream)
    return Error{fmt::format("-condebug: {} cannot be written ({})", file->name, std::strerror(errno))};
  return std::unique_ptr<ConsoleLog>(new ConsoleLog(std::move(file)));
}

ConsoleLog::ConsoleLog(std::shared_ptr<File> file)
    : listener_(add_log_listener([file](LogLevel level, std::string_view text) { file->write(level, text); })) {
  log_info("Log file: {}", file->name);
}

ConsoleLog::~ConsoleLog() { remove_log_listener(listener_); }

void ConsoleLog::File::write(LogLevel level, std::string_view text) {
  bool failed = false, full = false;
  {
    const std::lock_guard lock(mutex);
    if (!stream.is_open()) return;
    const std::uint64_t bytes = prefix(level).size() + text.size() + 1;
    full = bytes > room;
    if (!full) stream << prefix(level) << text << '\n' << std::flush;
    room -= full ? 0 : bytes;
    failed = !stream;
    if (failed || full) stream.close();
  }
  if (failed) log_error("-condebug: {} cannot be written any more and ends here", name);
  if (full) log_error("-condebug: {} has as much as may be in a file and ends here", name);
}

}  // namespace fb::host
