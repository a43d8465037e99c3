// Everything between the picture and the console: what is shown during play, at a level's end, between episodes, while
// a level loads. In QuakeSpasm's order.
#pragma once

#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/hud_view.h"

namespace fb::ui {

// Whether the player looks at the game (and not at the console or a menu): messages in the middle, and what covers the
// game at a level's end, wait till then.
enum class Attention { kGame, kElsewhere };

// The status bar, the mod's own where it has one.
void draw_current_bar(scene::DrawList& list, Atlas& atlas, const HudView& view);

// Returns whether the console's newest lines may be shown over it.
bool draw_hud(scene::DrawList& list, Atlas& atlas, const HudView& view, Attention attention);

}  // namespace fb::ui
