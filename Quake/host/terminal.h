// Lines that somebody types at the program's terminal, or pipes into it, without waiting for them.
#pragma once

#include <optional>
#include <string>

namespace fb::host {

class TerminalLines {
 public:
  // `file`: the descriptor to read; standard input.
  explicit TerminalLines(int file = 0) : file_(file) {}
  // The next whole line without its end; nothing if there is none yet, or none will come.
  std::optional<std::string> next();

 private:
  bool read_more();

  int file_;
  bool ended_ = false;
  std::string text_;
};

}  // namespace fb::host
