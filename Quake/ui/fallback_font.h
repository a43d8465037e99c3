// The console's letters where there is no game data to bring them: our own, drawn here, in the places where Quake's
// conchars have theirs.
#pragma once

#include "formats/image.h"

namespace fb::ui {

// 128x128 pixels: 16x16 glyphs of 8x8, a character's code is its place. 0 is nothing, 1 the letters of codes 0 to 127,
// 2 those of 128 to 255, which show the same in gold, as in Quake.
formats::IndexedImage fallback_font();

}  // namespace fb::ui
