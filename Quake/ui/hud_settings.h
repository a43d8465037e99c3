// The screen's cvars as plain numbers. Names, defaults and ranges are QuakeSpasm's where QuakeSpasm has them; hud style
// and speed are Ironwail's.
#pragma once

#include "console/console.h"

namespace fb::ui {

// One row a cvar: member, name, default, least, most, whether config.cfg holds it, help.
#define FB_HUD_CVARS(X)                                                                                              \
  X(bar_scale, "scr_sbarscale", 1, 0, 100, true, "size of the status bar: output pixels to one of its own")          \
  X(bar_alpha, "scr_sbaralpha", 0.75f, 0, 1, true, "opacity of the status bar's background")                         \
  X(menu_scale, "scr_menuscale", 1, 0, 100, true, "size of menus, centre prints, plaques and scoreboards")           \
  X(console_scale, "scr_conscale", 1, 0, 100, true, "text size of the console")                                      \
  X(console_width, "scr_conwidth", 0, 0, 16384, true, "width of the console, its own pixels; 0: by scr_conscale")    \
  X(crosshair_scale, "scr_crosshairscale", 1, 1, 10, true, "size of the crosshair")                                  \
  X(auto_scale, "scr_autoscale", 1, 0, 1, true,                                                                      \
    "1: scales that are 1 follow the picture's size, so that 640x360 pixels of theirs fit; 0: they are 1")           \
  X(crosshair, "crosshair", 0, 0, 1, true, "1: show a crosshair")                                                    \
  X(style, "scr_hudstyle", 0, 0, 3, true,                                                                            \
    "status bar: 0 Quake's, 1 in the corners with ammunition in the middle, 2 with it at the right, 3 QuakeWorld's") \
  X(clock, "scr_clock", 0, 0, 1, false, "1: show the level's time")                                                  \
  X(show_fps, "scr_showfps", 0, 0, 1, true, "1: show the frame rate, frames a second")                               \
  X(show_speed, "scr_showspeed", 0, 0, 1, true, "1: show the player's speed over ground, units a second")            \
  X(speed_offset, "scr_showspeed_ofs", 0, -1000, 1000, true, "place of the speed: pixels below the crosshair")       \
  X(show_pause, "showpause", 1, 0, 1, false, "1: show that the game is paused")                                      \
  X(show_turtle, "showturtle", 0, 0, 1, false, "1: show a turtle where frames take a tenth of a second or longer")   \
  X(center_seconds, "scr_centertime", 2, 0, 1000, false, "seconds that a centre print stays on the screen")          \
  X(print_speed, "scr_printspeed", 8, 0, 100000, false, "speed of the texts between episodes, letters a second")     \
  X(notify_seconds, "con_notifytime", 3, 0, 1000, false, "seconds that notify lines stay on the screen")             \
  X(demo_bar_seconds, "scr_demobar_timeout", 1, -1, 1000, true,                                                      \
    "seconds that the bar of a demo stays after a key that directs the demo; 0: always, negative: never")            \
  X(console_alpha, "scr_conalpha", 0.5f, 0, 1, true, "opacity of the console over a game")

struct HudSettings {
#define FB_MEMBER(member, name, value, least, most, archived, help) float member = value;
  FB_HUD_CVARS(FB_MEMBER)
#undef FB_MEMBER
  float view_size = 100.0f;  // viewsize: the client registers it
};

// Registers the cvars, hudstyle (Ironwail's name of scr_hudstyle) among them, and the commands sizeup and sizedown.
void register_hud_cvars(con::Console& console);
// What the cvars say; scales that are 1 are those of an output of this size (scr_autoscale).
HudSettings read_hud_settings(const con::Console& console, int output_width, int output_height);

}  // namespace fb::ui
