#include "ui/wrap.h"

#include <algorithm>

namespace fb::ui {

std::vector<std::string_view> wrap(std::string_view text, std::size_t columns) {
  columns = std::max<std::size_t>(columns, 1);
  std::vector<std::string_view> pieces;
  while (true) {
    const std::size_t line_end = std::min(text.find('\n'), text.size());
    if (line_end <= columns) {
      pieces.push_back(text.substr(0, line_end));
      if (line_end == text.size()) return pieces;
      text.remove_prefix(line_end + 1);
      continue;
    }
    // The line may also break at a blank just past the edge.
    const std::size_t blank = text.substr(0, columns + 1).rfind(' ');
    // Does not break inside the indentation: the word after it is too long anyway.
    const bool cut_a_word = blank == text.npos || blank < text.find_first_not_of(' ');
    const std::size_t length = cut_a_word ? columns : blank;
    pieces.push_back(text.substr(0, length));
    text.remove_prefix(cut_a_word ? length : length + 1);
  }
}

}  // namespace fb::ui
