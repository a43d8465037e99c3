// Small things over the game: crosshair, plaques, warnings, clock, speed. QuakeSpasm's places.
#pragma once

#include <string_view>

#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/hud_view.h"

namespace fb::ui {

void draw_crosshair(scene::DrawList& list, Atlas& atlas, const HudView& view);
// The server has been silent for a while; frames are slow.
void draw_warnings(scene::DrawList& list, Atlas& atlas, const HudView& view);
void draw_pause(scene::DrawList& list, Atlas& atlas, const HudView& view);
void draw_loading(scene::DrawList& list, Atlas& atlas, const HudView& view);
// What is shown before there is a first picture: the same plaque, a bar that goes to and fro, and a line of text.
// `seconds` since it was shown first.
void draw_start(scene::DrawList& list, Atlas& atlas, const HudView& view, double seconds, std::string_view what);
// Frame rate, the level's time, the player's speed.
void draw_readings(scene::DrawList& list, Atlas& atlas, const HudView& view);

// The highest speed of each twentieth of a second, so that it can be read.
class SpeedReading {
 public:
  void frame(double now, float speed);
  float value() const { return shown_; }  // negative: nothing has been measured

 private:
  double since_ = -1.0;
  float most_ = 0.0f, shown_ = -1.0f;
};

// True from the third frame in a row that took long.
class SlowFrames {
 public:
  void frame(double seconds) { count_ = seconds < 0.1 ? 0 : count_ + 1; }
  bool slow() const { return count_ >= 3; }

 private:
  int count_ = 0;
};

}  // namespace fb::ui
