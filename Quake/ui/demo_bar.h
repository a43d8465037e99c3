// The bar over a demo that is directed: where it is, how fast it plays, and a line that can be pointed at.
#pragma once

#include <optional>
#include <string>

#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/hud_view.h"

namespace fb::ui {

struct DemoBar {
  std::string name;
  double seconds = 0.0, length = 0.0;  // of the demo
  double rate = 1.0;                   // seconds of the demo in one of the clock
};

// Above the status bar, at its scale.
void draw_demo_bar(scene::DrawList& list, Atlas& atlas, const HudView& view, const DemoBar& bar);

// The time of a demo of this length that the pointer (output pixels) points at; none where it is not on the bar. Once
// it is held (`held`) it may be anywhere: its side-to-side place counts.
std::optional<double> demo_time_at(const HudSettings& settings, ivec2 output, double length, const vec2& pointer,
                                   bool held);

}  // namespace fb::ui
