// What a mod draws in the place of the status bar and the scoreboards (csqc/mod_hud.h).
#pragma once

#include "scene/draw_list.h"

namespace fb::ui {

struct HudView;

class ModBar {
 public:
  virtual ~ModBar() = default;

  // kBar: the scoreboard of a deathmatch is still the game's to draw.
  enum class Drawn { kNothing, kBar, kBarAndScores };
  // Whether it would draw one now.
  virtual bool has_bar() const = 0;
  // In the status bar's place. Where nothing was drawn the list is as it was.
  virtual Drawn draw_bar(scene::DrawList& list, const HudView& view) = 0;
  // In the place of what a level's end tells. False: nothing was drawn, and the list is as it was.
  virtual bool draw_level_end(scene::DrawList& list, const HudView& view) = 0;
};

}  // namespace fb::ui
