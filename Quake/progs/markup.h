// FTE's marks in texts of status bars (vkQuake draws them, too): ^1 to ^9 and ^xRGB colour what follows, ^m changes to
// the other alphabet, ^U and ^{ name a character by its code. Characters of the code points U+E000 to U+E0FF are
// Quake's own.
#pragma once

#include <string_view>
#include <vector>

#include "base/maths.h"

namespace fb::progs {

struct Letter {
  unsigned char code = 0;
  vec4 color{1.0f};
};

// `color` is that of letters without a mark; marks' colours multiply it. A caret that begins no mark is a letter.
std::vector<Letter> marked_up(std::string_view text, const vec4& color);

}  // namespace fb::progs
