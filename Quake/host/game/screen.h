// What lies over the picture: status bar, messages, console, menu.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "client/client.h"
#include "console/console.h"
#include "csqc/mod_hud.h"
#include "host/game/key_router.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/demo_bar.h"
#include "ui/hud_view.h"
#include "ui/overlays.h"
#include "ui/signs.h"

namespace fb::host {

class Screen {
 public:
  // Registers the screen's cvars (ui/hud_settings.h), +showscores and what a mod's status bar needs (csqc/mod_hud.h).
  // Console and keys must outlive it, and it the client whose game it shows.
  Screen(con::Console& console, csqc::ModHudServices services, KeyRouter& keys, ui::Rules rules);

  // A moment of the screen.
  struct Moment {
    uvec2 size{0, 0};      // output pixels
    double now = 0.0;      // seconds
    double seconds = 0.0;  // since the last frame
    bool lines = true;     // the console and its newest lines, which follow the clock on the wall
    std::optional<ui::DemoBar> demo_bar = std::nullopt;
    std::function<void(scene::DrawList&, ui::Atlas&)> panel = nullptr;  // draws below console and menu
  };
  // Where the game's picture is in an output of this size, before it is made (ui/view_area.h).
  scene::Area picture_area(const cl::Client& client, uvec2 size);
  // The draw list of this frame. Where the client has no world the console fills the picture.
  const scene::DrawList& draw(const cl::Client& client, const Moment& moment);
  // The plaque of a level that is about to be loaded.
  const scene::DrawList& draw_loading(const cl::Client& client, uvec2 size);
  // Before there is a first picture (ui::draw_start).
  const scene::DrawList& draw_start(const cl::Client& client, uvec2 size, double seconds, std::string_view what);

 private:
  ui::HudView view_of(const cl::Client& client, uvec2 size);
  void follow_game(const cl::Client& client, const Moment& moment);
  void draw_console(const ui::HudView& view, bool game, bool lines_too);
  void draw_menu(uvec2 size, double now);

  con::Console& console_;
  KeyRouter& keys_;
  const ui::Rules rules_;
  ui::Atlas atlas_;
  csqc::ModHud mod_hud_;
  ui::FrameRate rate_;
  ui::SpeedReading speed_;
  ui::SlowFrames slow_;
  scene::DrawList list_;
  bool show_scores_ = false;
};

}  // namespace fb::host
