// The status bar, in the forms of scr_hudstyle and viewsize: all of it with the inventory (viewsize 100), without it
// (110), or nothing but the scoreboard when that is asked for (120). Layouts are QuakeSpasm's and Ironwail's.
#pragma once

#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/hud_view.h"

namespace fb::ui {

void draw_status_bar(scene::DrawList& list, Atlas& atlas, const HudView& view);

}  // namespace fb::ui
