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

Result<std::unique_ptr<ConsoleLog>> ConsoleLog::open(const std::filesystem::path& path) {
  std::error_code ignored;  // opening fails for the same reason
  std::filesystem::create_directories(path.parent_path(), ignored);
  auto file = std::make_shared<File>();
  file->name = path.string();
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
  bool ended = false;
  {
    const std::lock_guard lock(mutex);
    if (!stream.is_open()) return;
    stream << prefix(level) << text << '\n' << std::flush;
    ended = !stream;
    if (ended) stream.close();
  }
  if (ended) log_error("-condebug: {} cannot be written any more and ends here", name);
}

}  // namespace fb::host
