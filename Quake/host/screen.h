// The 2D overlays of the picture, and the routing of keys: typing while the console is open, bindings otherwise.
#pragma once

#include <string>
#include <vector>

#include "client/client.h"
#include "console/bindings.h"
#include "console/console.h"
#include "console/input_line.h"
#include "platform/input_event.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/overlays.h"

namespace fb::host {

class Screen {
 public:
  // Registers scr_showfps, toggleconsole and the bindings.
  Screen(con::Console& console, FileLoader files);

  // Handles a key, text or focus event; ignores others.
  void handle(const platform::InputEvent& event);
  bool console_open() const { return open_; }
  void close_console();

  // The draw list of this frame. `game`: whether there is a world behind it; without one the console fills the picture.
  const scene::DrawList& draw(const cl::Hud& hud, bool game, uvec2 size, double now);

 private:
  void type(const platform::InputEvent& event);

  con::Console& console_;
  con::Bindings bindings_;
  con::InputLine input_;
  con::Cvar& show_fps_;
  ui::Atlas atlas_;
  ui::FrameRate rate_;
  scene::DrawList list_;
  bool open_ = false;
  bool in_game_ = false;  // in the last frame; without a game all typing goes to the console
  std::size_t scrolled_up_ = 0;
};

}  // namespace fb::host
