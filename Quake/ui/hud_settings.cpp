#include "ui/hud_settings.h"

#include "ui/canvas.h"

namespace fb::ui {
namespace {

constexpr float kSizeStep = 10.0f;
constexpr const char* kViewSize = "viewsize";

void resize_view(con::Console& console, float by) {
  if (con::Cvar* size = console.find_cvar(kViewSize)) size->set(size->value() + by);
}

}  // namespace

void register_hud_cvars(con::Console& console) {
#define FB_REGISTER(member, name, value, least, most, archived, help) \
  console.add_cvar({name, con::number_text(value), help, archived ? con::kCvarArchive : con::kCvarPlain, least, most});
  FB_HUD_CVARS(FB_REGISTER)
#undef FB_REGISTER
  console.add_command("sizeup", "sizeup: less of the status bar (viewsize)",
                      [&console](const con::Args&) { resize_view(console, kSizeStep); });
  console.add_command("sizedown", "sizedown: more of the status bar (viewsize)",
                      [&console](const con::Args&) { resize_view(console, -kSizeStep); });
  // The same setting by Ironwail's name, which mods read: each follows the other.
  con::Cvar& style = console.cvar("scr_hudstyle");
  con::Cvar& alias =
      console.add_cvar({"hudstyle", style.string(), "scr_hudstyle by Ironwail's name", con::kCvarPlain, 0.0f, 3.0f});
  style.add_listener([&alias](const con::Cvar& changed) { alias.set(changed.string()); });
  alias.add_listener([&style](const con::Cvar& changed) { style.set(changed.string()); });
}

HudSettings read_hud_settings(const con::Console& console, int output_width, int output_height) {
  HudSettings s;
#define FB_READ(member, name, initial, least, most, archived, help) s.member = console.cvar(name).value();
  FB_HUD_CVARS(FB_READ)
#undef FB_READ
  if (const con::Cvar* size = console.find_cvar(kViewSize)) s.view_size = size->value();
  if (s.auto_scale != 0.0f) {
    const auto automatic = static_cast<float>(automatic_scale(output_width, output_height));
    for (float* scale : {&s.bar_scale, &s.menu_scale, &s.console_scale, &s.crosshair_scale})
      if (*scale == 1.0f) *scale = automatic;
  }
  return s;
}

}  // namespace fb::ui
