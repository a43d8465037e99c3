// Wraps text into lines.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace fb::ui {

// Splits the text into lines of at most `columns` (1 or more) characters, at newlines and if possible between words;
// the blank at a break belongs to no line. An empty text gives one empty line.
std::vector<std::string_view> wrap(std::string_view text, std::size_t columns);

}  // namespace fb::ui
