// Reads lines typed at the program's terminal, or piped into it, without waiting.
#pragma once

#include <optional>
#include <string>

namespace fb::host {

class TerminalLines {
 public:
  // `file`: the descriptor to read; default standard input.
  explicit TerminalLines(int file = 0) : file_(file) {}
  // The next complete line without its newline; nothing if there is none yet, or no more will come.
  std::optional<std::string> next();

 private:
  bool read_more();

  int file_;
  bool ended_ = false;
  std::string text_;
};

}  // namespace fb::host
