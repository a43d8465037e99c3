// Where the game's picture is: all of the output, or what viewsize and an opaque status bar leave of it, and what
// stands around it. Sizes are QuakeSpasm's.
#pragma once

#include "base/maths.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/hud_view.h"
#include "ui/painter.h"

namespace fb::ui {

// Between levels, and where a mod draws the bar, it is all of the output.
scene::Area view_area(const HudView& view);

// Fills a rectangle of the output with backtile, whatever its size in squares of 64 pixels from the output's corner.
void draw_tiles(Painter& painter, const vec2& min, const vec2& max);
// Tiles around the picture, above the status bar.
void draw_border(scene::DrawList& list, Atlas& atlas, const HudView& view);

}  // namespace fb::ui
