// What Dear ImGui wants drawn, as the rectangles that all 2D is made of here (scene/draw_list.h): its letters and boxes
// are rectangles already; any other triangle becomes rows of one pixel.
#pragma once

#include "scene/draw_list.h"
#include "ui/atlas.h"

struct ImDrawData;

namespace fb::panel {

// Appends it. `font` is where ImGui's own texture lies in the list's atlas; a unit of ImGui's is `scale` output pixels.
void append_draw_data(scene::DrawList& list, const ImDrawData& data, const ui::Picture& font, float scale);

}  // namespace fb::panel
