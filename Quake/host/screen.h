// What lies over the picture (status bar, messages, console), and the routing of keys: typing while the console is
// open, bindings otherwise.
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
#include "ui/hud_view.h"
#include "ui/overlays.h"
#include "ui/signs.h"

namespace fb::host {

class Screen {
 public:
  // Registers the screen's cvars (ui/hud_settings.h), +showscores, toggleconsole and the bindings.
  Screen(con::Console& console, FileLoader files, ui::Rules rules);

  // Handles a key, text or focus event; ignores others.
  void handle(const platform::InputEvent& event);
  bool console_open() const { return open_; }
  void close_console();

  // A moment of the screen.
  struct Moment {
    uvec2 size{0, 0};      // output pixels
    double now = 0.0;      // seconds
    double seconds = 0.0;  // since the last frame
    bool lines = true;     // the console and its newest lines, which follow the clock on the wall
  };
  // The draw list of this frame. Where the client has no world the console fills the picture.
  const scene::DrawList& draw(const cl::Client& client, const Moment& moment);
  // The plaque of a level that is about to be loaded.
  const scene::DrawList& draw_loading(const cl::Client& client, uvec2 size);

 private:
  void type(const platform::InputEvent& event);
  ui::HudView view_of(const cl::Client& client, uvec2 size) const;
  void draw_console(const ui::HudView& view, bool game, bool lines_too);

  con::Console& console_;
  con::Bindings bindings_;
  con::InputLine input_;
  const ui::Rules rules_;
  ui::Atlas atlas_;
  ui::FrameRate rate_;
  ui::SpeedReading speed_;
  ui::SlowFrames slow_;
  scene::DrawList list_;
  bool open_ = false;
  bool show_scores_ = false;
  bool in_game_ = false;  // in the last frame; without a game all typing goes to the console
  std::size_t scrolled_up_ = 0;
};

}  // namespace fb::host
