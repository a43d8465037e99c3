// -condebug: writes all log lines to a file as they come, so that they survive a crash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "base/log.h"
#include "base/result.h"
#include "fs/held_file.h"

namespace fb::host {

class ConsoleLog {
 public:
  // Truncates the file, and creates missing folders. Where another program's log is there, the file is NAME2, NAME3 ...
  // It ends, with a message, before it has more than `most_bytes`.
  static Result<std::unique_ptr<ConsoleLog>> open(const std::filesystem::path& path,
                                                  std::uint64_t most_bytes = std::uint64_t{1} << 30);
  ~ConsoleLog();
  ConsoleLog(const ConsoleLog&) = delete;
  ConsoleLog& operator=(const ConsoleLog&) = delete;

 private:
  // Shared with the listener, which another thread may still be running when it is removed.
  struct File {
    File(fs::HeldFile file, std::string called, std::uint64_t most_bytes)
        : held(std::move(file)), name(std::move(called)), room(most_bytes) {}

    std::mutex mutex;
    fs::HeldFile held;
    std::string name;
    std::uint64_t room = 0;  // bytes
    bool ended = false;

    void write(LogLevel level, std::string_view text);
  };
  explicit ConsoleLog(std::shared_ptr<File> file);

  int listener_ = 0;
};

}  // namespace fb::host
