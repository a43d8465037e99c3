// The console's font for when there is no game data: drawn for Fullbright, at the positions of Quake's conchars.
#pragma once

#include "formats/image.h"

namespace fb::ui {

// 128x128 pixels: 16x16 glyphs of 8x8 at the position of their code. Pixels are 0 for empty, 1 for the letters of codes
// 0 to 127, and 2 for those of 128 to 255, which are the same letters in gold, as in Quake.
formats::IndexedImage fallback_font();

}  // namespace fb::ui
