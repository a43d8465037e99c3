// The 2D overlays of the picture: messages, console, menu.
#pragma once

#include <string>

#include "client/client.h"
#include "console/console.h"
#include "host/key_router.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/overlays.h"

namespace fb::host {

class Screen {
 public:
  // Registers scr_showfps. Console and keys must outlive it.
  Screen(con::Console& console, FileLoader files, KeyRouter& keys);

  // The draw list of this frame. `game`: whether there is a world behind it; without one the console fills the picture.
  const scene::DrawList& draw(const cl::Hud& hud, bool game, uvec2 size, double now);

 private:
  void draw_menu(uvec2 size, double now);

  con::Console& console_;
  KeyRouter& keys_;
  con::Cvar& show_fps_;
  ui::Atlas atlas_;
  ui::FrameRate rate_;
  scene::DrawList list_;
};

}  // namespace fb::host
