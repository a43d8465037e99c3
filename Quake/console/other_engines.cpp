#include "console/other_engines.h"

#include <fmt/format.h>

#include <string_view>

namespace fb::con {
namespace {

struct Foreign {
  const char *name, *value, *what;
};
constexpr Foreign kIronwail[] = {{"vid_fsaamode", "0", "kind of multisample anti-aliasing"},
                                 {"scr_pixelaspect", "1", "shape of the 2D pixels"},
                                 {"r_softemu", "0", "look of the software renderer"},
                                 {"r_oit", "1", "order of translucent surfaces"},
                                 {"r_alphasort", "1", "order of translucent surfaces"},
                                 {"r_md5", "1", "former name of r_enhancedmodels"},
                                 {"ui_mouse", "1", "1: use the mouse in menus"},
                                 {"ui_live_preview", "1", "1: menus show settings as they change"},
                                 {"cl_confirmquit", "1", "1: ask before the program ends"},
                                 {"con_maxcols", "0", "most columns of the console"},
                                 {"con_notifyfade", "0", "1: notify lines fade"},
                                 {"con_notifycenter", "0", "1: notify lines in the middle"},
                                 {"snd_waterfx", "1", "sound under water"}};
constexpr Foreign kQuakeWorld[] = {{"topcolor", "0", "colour of the shirt (here: color)"},
                                   {"bottomcolor", "0", "colour of the trousers (here: color)"},
                                   {"cl_fakeshaft", "0", "prediction of the lightning gun's beam"},
                                   {"cl_warncmd", "1", "1: complain about unknown commands"},
                                   {"cl_stainmaps", "0", "1: marks on walls"},
                                   {"cl_decals", "0", "1: marks on walls"},
                                   {"cl_particles_quake", "0", "1: particles as in Quake"},
                                   {"cl_beams_polygons", "1", "1: beams of polygons"},
                                   {"gl_texturemode_viewmodels", "", "filtering of the view model's textures"},
                                   {"gl_texturemode_sky", "", "filtering of the sky's textures"},
                                   {"gl_texturemode_hud", "", "filtering of 2D pictures"},
                                   {"gl_texturemode2d", "", "filtering of 2D pictures"},
                                   {"gl_overbright_model", "1", "1: light may brighten models' textures"},
                                   {"gl_smoothfont", "1", "1: filtered letters"},
                                   {"r_lerpmuzzlehack", "1", "1: interpolation leaves muzzle flashes out"},
                                   {"r_font_linear", "1", "1: filtered letters"},
                                   {"r_font_postprocess_mono", "0", "1: letters without grey"},
                                   {"r_waterscroll", "0", "speed of scrolling liquids"},
                                   {"r_menutint", "", "tint of the picture behind menus"},
                                   {"r_stains", "0", "marks on walls"},
                                   {"r_part_classic_square", "0", "1: square particles"},
                                   {"r_viewmodel_fov", "", "field of view of the view model"},
                                   {"m_preset_chosen", "0", "1: a preset has been chosen"},
                                   {"com_fullgamename", "", "the game's name"},
                                   {"sb_hidenetquake", "0", "1: list no servers of this protocol"},
                                   {"sb_showmap", "0", "1: list servers' maps"}};
constexpr Foreign kCommands[] = {{"serverinfo", "", "QuakeWorld's rules that servers announce"},
                                 {"if", "", "FTEQW's conditions in scripts; what stands behind is not run"},
                                 {"vid_reload", "", "FTEQW's reload of textures"},
                                 {"menu_restart", "", "FTEQW's restart of its menus"}};

void add_cvar(Console& console, const Foreign& row, std::string_view engine) {
  if (console.find_cvar(row.name) || console.has_command(row.name)) return;
  console.add_cvar(row.name, row.value, fmt::format("{}; no effect here: it is a setting of {}", row.what, engine),
                   kCvarNoEffect);
}

}  // namespace

void add_other_engines(Console& console) {
  for (const Foreign& row : kIronwail) add_cvar(console, row, "Ironwail");
  for (const Foreign& row : kQuakeWorld) add_cvar(console, row, "QuakeWorld's engines");
  for (const Foreign& row : kCommands) {
    if (console.find_cvar(row.name) || console.has_command(row.name)) continue;
    console.add_command(row.name, fmt::format("{}: no effect: {}", row.name, row.what), [](const Args&) {});
  }
}

}  // namespace fb::con
