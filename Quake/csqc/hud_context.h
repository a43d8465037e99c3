// What the builtins of a mod's status bar work on: the game as the client knows it, and, while a function that draws
// runs, where it draws.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "base/maths.h"
#include "client/session/hud.h"
#include "console/console.h"
#include "progs/builtin_table.h"
#include "ui/atlas.h"
#include "ui/painter.h"

namespace fb::csqc {

// What of a frame the session (cl::Hud) does not hold.
struct Moment {
  double now = 0.0;      // seconds of a clock that never stops
  double seconds = 0.0;  // since the last frame
  vec3 view_angles{0.0f};
  bool demo = false, local_server = false;
  bool menu_open = false;  // scores are not shown over it
};

// Pictures by the names that QuakeC gives them.
class Pictures {
 public:
  explicit Pictures(ui::Atlas& atlas) : atlas_(atlas) {}
  // "gfx/NAME" without an ending is gfx.wad's NAME, as is a name without a folder, or any name with `in_wad`; other
  // names are files, of this ending or another that pictures have. nullptr, after one message for each name, if there
  // is none.
  const ui::Picture* find(std::string_view name, bool in_wad = false);
  bool knows(std::string_view name) const;  // found before
  ui::Atlas& atlas() { return atlas_; }

 private:
  static constexpr std::size_t kMostNames = 4096;
  const ui::Picture* look_for(const std::string& name, bool in_wad);
  ui::Atlas& atlas_;
  std::map<std::string, const ui::Picture*, std::less<>> found_;
};

struct HudContext {
  HudContext(con::Console& console, ui::Atlas& atlas) : console(console), pictures(atlas) {}
  con::Console& console;
  Pictures pictures;
  std::function<void(std::string_view name)> play_sound;          // may be absent
  std::function<void(const std::string& name)> register_command;  // may be absent
  const cl::Hud* hud = nullptr;                                   // null: no game is shown
  Moment moment;
  // While a function runs that draws; else null.
  ui::Painter* painter = nullptr;
  std::size_t drawn = 0;  // by it so far
};

// The builtins of status bars, on top of progs' standard_builtins. The context must outlive the table.
void add_hud_builtins(progs::BuiltinTable& table, HudContext& context);

// A file for each kind.
void add_draw_builtins(progs::BuiltinTable& table, HudContext& context);  // drawpic, drawstring, stringwidth ...
void add_game_builtins(progs::BuiltinTable& table, HudContext& context);  // getstatf, getplayerkeyvalue, serverkey ...

}  // namespace fb::csqc
