// Lines that fit.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace fb::ui {

// The text in pieces of at most `columns` (1 or more) characters, cut at newlines and between words where it can be;
// the blank at a cut belongs to no piece. An empty text is one empty piece.
std::vector<std::string_view> wrap(std::string_view text, std::size_t columns);

}  // namespace fb::ui
