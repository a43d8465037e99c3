#include "host/game/console_log.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>
#include <utility>

namespace fb::host {
namespace {

constexpr int kMostPrograms = 9;  // with a log in one folder

std::string_view prefix(LogLevel level) {
  return level == LogLevel::kWarning ? "warning: " : level == LogLevel::kError ? "error: " : "";
}

}  // namespace

Result<std::unique_ptr<ConsoleLog>> ConsoleLog::open(const std::filesystem::path& path, std::uint64_t most_bytes) {
  std::error_code ignored;  // opening fails for the same reason
  std::filesystem::create_directories(path.parent_path(), ignored);
  std::optional<Error> failure;
  for (int i = 1; i <= kMostPrograms; ++i) {
    std::filesystem::path own = path;
    if (i > 1) own.replace_filename(fmt::format("{}{}{}", path.stem().string(), i, path.extension().string()));
    auto held = fs::HeldFile::take(own);
    const Status ready = held ? held->cut(0) : Status(held.error());
    if (ready)
      return std::unique_ptr<ConsoleLog>(
          new ConsoleLog(std::make_shared<File>(*std::move(held), own.string(), most_bytes)));
    if (!failure) failure = ready.error();
  }
  return Error{fmt::format("-condebug: {}", failure->message)};
}

ConsoleLog::ConsoleLog(std::shared_ptr<File> file)
    : listener_(add_log_listener([file](LogLevel level, std::string_view text) { file->write(level, text); })) {
  log_info("Log file: {}", file->name);
}

ConsoleLog::~ConsoleLog() { remove_log_listener(listener_); }

void ConsoleLog::File::write(LogLevel level, std::string_view text) {
  const std::string line = fmt::format("{}{}\n", prefix(level), text);
  const char* why = nullptr;
  {
    const std::lock_guard lock(mutex);
    if (ended) return;
    if (line.size() > room)
      why = "has as much as may be in a file";
    else if (!held.append(ByteView(reinterpret_cast<const std::uint8_t*>(line.data()), line.size())))
      why = "cannot be written any more";
    room -= why ? 0 : line.size();
    ended = why != nullptr;
  }
  if (why) log_error("-condebug: {} {} and ends here", name, why);
}

}  // namespace fb::host
