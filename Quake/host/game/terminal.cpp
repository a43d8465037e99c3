#include "host/game/terminal.h"

#include <cstddef>

namespace fb::host {

std::optional<std::string> TerminalLines::next() {
  constexpr std::size_t kLongestLine = 65536;
  std::size_t end = text_.find('\n');
  while (end == std::string::npos && text_.size() < kLongestLine && read_more()) end = text_.find('\n');
  if (end == std::string::npos) {
    if (!(ended_ || text_.size() >= kLongestLine) || text_.empty()) return std::nullopt;
    end = text_.size();  // the last line may have no newline
  }
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  return line;
}

}  // namespace fb::host
