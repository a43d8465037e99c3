#include "console/quakespasm_cvars.h"

#include <fmt/format.h>

namespace fb::con {
namespace {

constexpr const char* kSound = "a dedicated server is silent";
constexpr const char* kMixing = "sound is mixed on a thread of its own";
constexpr const char* kPad = "a dedicated server has no game controllers";
constexpr const char* kHud = "this program draws no screen";
constexpr const char* kConsole = "the look of the console cannot be changed yet";
constexpr const char* kTracer = "the path tracer has no such feature";
constexpr const char* kVideo = "the command line sets up the window";
constexpr const char* kDiagnosis = "it reports on QuakeSpasm's internals";
constexpr const char* kAlways = "it is always on";

struct Row {
  const char* name;
  const char* value;
  bool archived;  // by QuakeSpasm
  const char* what;
  const char* why;  // there is no effect
};
constexpr Row kRows[] = {
    {"_snd_mixahead", "0.1", true, "seconds of sound mixed ahead", kMixing},
    {"ambient_fade", "100", false, "fade-in speed of ambient sounds of liquids and sky", kSound},
    {"ambient_level", "0.3", false, "volume of ambient sounds of liquids and sky", kSound},
    {"bgm_extmusic", "1", true, "1: music from files instead of a disc", kSound},
    {"bgmvolume", "1", true, "volume of the music", kSound},
    {"nosound", "0", false, "1: no sound", kSound},
    {"precache", "1", false, "1: load sounds when a level begins", kSound},
    {"loadas8bit", "0", false, "1: keep sounds in 8 bits", kSound},
    {"snd_filterquality", "1", false, "quality of sound resampling", kSound},
    {"snd_mixspeed", "44100", false, "mixing rate, Hz", kSound},
    {"snd_noextraupdate", "0", false, "1: do not mix sound while a frame is drawn", kMixing},
    {"snd_show", "0", false, "1: list the sounds that play", kDiagnosis},
    {"sndspeed", "11025", false, "rate of loaded sounds, Hz", kSound},
    {"volume", "0.7", true, "volume of sounds", kSound},
    {"joy_deadzone", "0.175", true, "dead zone of both sticks (QuakeSpasm up to 0.95)",
     "joy_deadzone_look and joy_deadzone_move have taken its place"},
    {"joy_deadzone_look", "0.175", true, "dead zone of the look stick", kPad},
    {"joy_deadzone_move", "0.175", true, "dead zone of the move stick", kPad},
    {"joy_deadzone_trigger", "0.2", true, "dead zone of the triggers", kPad},
    {"joy_enable", "1", true, "1: use game controllers", kPad},
    {"joy_exponent", "2", true, "response exponent of the look stick", kPad},
    {"joy_exponent_move", "2", true, "response exponent of the move stick", kPad},
    {"joy_invert", "0", true, "1: invert the look stick's pitch", kPad},
    {"joy_outer_threshold_look", "0.02", true, "outer dead zone of the look stick", kPad},
    {"joy_outer_threshold_move", "0.02", true, "outer dead zone of the move stick", kPad},
    {"joy_sensitivity_pitch", "130", true, "pitch speed of the look stick, degrees a second", kPad},
    {"joy_sensitivity_yaw", "240", true, "yaw speed of the look stick, degrees a second", kPad},
    {"joy_swapmovelook", "0", true, "1: swap the sticks", kPad},
    {"crosshair", "0", true, "1: show a crosshair", kHud},
    {"scr_centertime", "2", false, "seconds that a centre print stays on the screen", kHud},
    {"scr_clock", "0", false, "1: show the level's time", kHud},
    {"scr_crosshairscale", "1", true, "size of the crosshair", kHud},
    {"scr_menuscale", "1", true, "size of the menus", kHud},
    {"scr_printspeed", "8", false, "speed of the texts between episodes, letters a second", kHud},
    {"scr_sbaralpha", "0.75", true, "opacity of the status bar", kHud},
    {"scr_sbarscale", "1", true, "size of the status bar", kHud},
    {"showpause", "1", false, "1: show that the game is paused", kHud},
    {"showturtle", "0", false, "1: show a turtle when frames are slow", kHud},
    {"con_logcenterprint", "1", false, "1: write centre prints to the console, too", kConsole},
    {"con_notifytime", "3", false, "seconds that notify lines stay on the screen", kHud},
    {"scr_conalpha", "0.5", true, "opacity of the console", kHud},
    {"scr_conscale", "1", true, "text size of the console", kHud},
    {"scr_conspeed", "500", true, "speed at which the console opens", kConsole},
    {"scr_conwidth", "0", true, "width of the console", kHud},
    {"scr_usekfont", "0", false, "1: the re-release's font", kConsole},
    {"cl_gun_fovscale", "1", true, "1: keep a wide field of view from stretching the view model", kTracer},
    {"contrast", "1", true, "contrast of the picture", kHud},
    {"gamma", "1", true, "gamma of the picture", kHud},
    {"gl_affinemodels", "0", false, "1: affine texture mapping of models", kTracer},
    {"gl_clear", "1", false, "1: clear the picture before each frame", kTracer},
    {"gl_cull", "1", false, "1: cull back faces", kTracer},
    {"gl_farclip", "65536", true, "far clip distance, units", kTracer},
    {"gl_finish", "0", false, "1: wait for the GPU after each frame", kTracer},
    {"gl_flashblend", "0", true, "1: draw dynamic lights as coloured balls", kTracer},
    {"gl_fullbrights", "1", true, "1: draw fullbright texels (here: r_emit_fullbright)", kTracer},
    {"gl_max_size", "0", false, "largest texture size, texels", kTracer},
    {"gl_nocolors", "0", false, "1: draw players without their colours", kTracer},
    {"gl_overbright", "1", true, "1: lightmaps may brighten textures", kTracer},
    {"gl_overbright_models", "1", true, "1: light may brighten models' textures", kTracer},
    {"gl_picmip", "0", false, "mipmap levels to drop from textures", kTracer},
    {"gl_playermip", "0", false, "mipmap levels to drop from players' textures", kTracer},
    {"gl_smoothmodels", "1", false, "1: smooth shading of models", kTracer},
    {"gl_subdivide_size", "128", true, "size of the polygons into which liquids are subdivided", kTracer},
    {"gl_texture_anisotropy", "1", true, "anisotropic filtering of textures", kTracer},
    {"gl_texturemode", "GL_LINEAR_MIPMAP_LINEAR", true, "filtering of textures (here: r_texture_filter)", kTracer},
    {"gl_triplebuffer", "1", true, "1: triple buffering", kTracer},
    {"gl_zfix", "0", false, "1: offset doors and lifts against z-fighting", kTracer},
    {"r_clearcolor", "2", true, "palette colour of the cleared picture", kTracer},
    {"r_drawflat", "0", false, "1: draw every surface in one colour", kTracer},
    {"r_fastsky", "0", false, "1: draw the sky in one colour", kTracer},
    {"r_flatlightstyles", "0", false, "1: lights do not flicker", kTracer},
    {"r_fullbright", "0", false, "1: draw everything without lighting", kTracer},
    {"r_lightmap", "0", false, "1: show lightmaps without textures", kTracer},
    {"r_lightmapwide", "1", false, "1: lightmaps of 10 bits a channel", kTracer},
    {"r_litwater", "1", false, "1: lightmaps on liquids", kTracer},
    {"r_norefresh", "0", false, "1: draw nothing", kTracer},
    {"r_noshadow_list",
     "progs/flame2.mdl,progs/flame.mdl,progs/bolt1.mdl,progs/bolt2.mdl,progs/bolt3.mdl,progs/laser.mdl", false,
     "models that cast no shadow with r_shadows", kTracer},
    {"r_novis", "0", true, "1: ignore the map's visibility data (PVS)", kTracer},
    {"r_oldskyleaf", "0", false, "1: visibility of sky leafs as in GLQuake", kTracer},
    {"r_oldwater", "0", true, "1: liquid surfaces warp as in GLQuake", kTracer},
    {"r_quadparticles", "1", true, "1: square particles", kTracer},
    {"r_shadows", "0", true, "1: flat shadows of models (here: light is traced)", kTracer},
    {"r_sky_quality", "12", false, "subdivision of the sky", kTracer},
    {"r_skyalpha", "1", false, "opacity of the sky's clouds", kTracer},
    {"r_stereo", "0", false, "stereo eye separation", kTracer},
    {"r_stereodepth", "128", false, "stereo focus distance", kTracer},
    {"r_waterquality", "8", false, "subdivision of liquid surfaces", kTracer},
    {"r_showbboxes", "0", false, "1: show the bounding boxes of entities", kTracer},
    {"r_showtris", "0", false, "1: show triangles", kTracer},
    {"vid_borderless", "0", true, "1: borderless window", kVideo},
    {"vid_bpp", "24", true, "bits a pixel", kVideo},
    {"vid_desktopfullscreen", "0", true, "1: full screen keeps the display's mode", kVideo},
    {"vid_fsaa", "2", true, "multisample anti-aliasing (here: r_fxaa and r_taa)", kVideo},
    {"vid_fullscreen", "0", true, "1: full screen", kVideo},
    {"vid_height", "600", true, "height of the picture", kVideo},
    {"vid_refreshrate", "60", true, "refresh rate of the display, Hz", kVideo},
    {"vid_vsync", "0", true, "vertical sync", kVideo},
    {"vid_width", "800", true, "width of the picture", kVideo},
    {"cl_shownet", "0", false, "1: print the server's messages", kDiagnosis},
    {"devstats", "0", false, "1: show the level's resource use", kDiagnosis},
    {"host_speeds", "0", false, "1: print the time of a frame's parts", kDiagnosis},
    {"in_debugkeys", "0", false, "1: print key events", kDiagnosis},
    {"r_pos", "0", false, "1: print the player's position", kDiagnosis},
    {"r_speeds", "0", false, "1: print the renderer's statistics", kDiagnosis},
    {"scr_showfps", "0", false, "1: show the frame rate", kDiagnosis},
    {"serverprofile", "0", false, "1: print the server's time", kDiagnosis},
    {"cfg_unbindall", "1", true, "1: config.cfg begins with unbindall", kAlways},
    {"external_ents", "1", true, "1: load a map's entities from its .ent file, if there is one", kAlways},
    {"external_vis", "1", true, "1: load a map's visibility from its .vis file, if there is one", kAlways},
    {"sv_fishfix", "1", true, "1: count each fish of id's game as one monster, not two",
     "the game's own count is kept"},
    {"sys_throttle", "0.02", true, "sleep of an idle frame, seconds", "frames sleep until they are due"},
    {"sys_ticrate", "0.05", false, "length of a dedicated server's tick, seconds", "this is no dedicated server"},
};

struct Setting {
  const char* name;
  const char* value;
};
// A player's, which mods read and set on dedicated servers, too. Where there is a client they are its own.
constexpr Setting kPlayersSettings[] = {
    {"_cl_color", "0"},
    {"_cl_name", "player"},
    {"chase_active", "0"},
    {"chase_back", "100"},
    {"chase_right", "0"},
    {"chase_up", "16"},
    {"cl_alwaysrun", "0"},
    {"cl_anglespeedkey", "1.5"},
    {"cl_backspeed", "200"},
    {"cl_bob", "0.02"},
    {"cl_bobcycle", "0.6"},
    {"cl_bobup", "0.5"},
    {"cl_forwardspeed", "200"},
    {"cl_maxpitch", "90"},
    {"cl_minpitch", "-90"},
    {"cl_movespeedkey", "2.0"},
    {"cl_nolerp", "0"},
    {"cl_pitchspeed", "150"},
    {"cl_sidespeed", "350"},
    {"cl_startdemos", "1"},
    {"cl_upspeed", "200"},
    {"cl_yawspeed", "140"},
    {"fov", "90"},
    {"fov_adapt", "1"},
    {"gl_cshiftpercent", "100"},
    {"gl_cshiftpercent_bonus", "100"},
    {"gl_cshiftpercent_contents", "100"},
    {"gl_cshiftpercent_damage", "100"},
    {"gl_cshiftpercent_powerup", "100"},
    {"gl_polyblend", "1"},
    {"lookspring", "0"},
    {"lookstrafe", "0"},
    {"m_forward", "1"},
    {"m_pitch", "0.022"},
    {"m_side", "0.8"},
    {"m_yaw", "0.022"},
    {"r_drawentities", "1"},
    {"r_drawviewmodel", "1"},
    {"r_drawworld", "1"},
    {"r_dynamic", "1"},
    {"r_lavaalpha", "0"},
    {"r_lerpmodels", "1"},
    {"r_lerpmove", "1"},
    {"r_particles", "1"},
    {"r_scale", "1"},
    {"r_skyfog", "0.5"},
    {"r_slimealpha", "0"},
    {"r_telealpha", "0"},
    {"r_viewmodel_quake", "0"},
    {"r_wateralpha", "1"},
    {"r_waterwarp", "1"},
    {"scr_ofsx", "0"},
    {"scr_ofsy", "0"},
    {"scr_ofsz", "0"},
    {"sensitivity", "3"},
    {"v_centermove", "0.15"},
    {"v_centerspeed", "500"},
    {"v_gunkick", "1"},
    {"v_idlescale", "0"},
    {"v_ipitch_cycle", "1"},
    {"v_ipitch_level", "0.3"},
    {"v_iroll_cycle", "0.5"},
    {"v_iroll_level", "0.1"},
    {"v_iyaw_cycle", "2"},
    {"v_iyaw_level", "0.3"},
    {"v_kickpitch", "0.6"},
    {"v_kickroll", "0.6"},
    {"v_kicktime", "0.5"},
    {"viewsize", "100"},
    {"r_nolerp_list",
     "progs/flame.mdl,progs/flame2.mdl,progs/braztall.mdl,progs/brazshrt.mdl,progs/longtrch.mdl,"
     "progs/flame_pyre.mdl,progs/v_saw.mdl,progs/v_xfist.mdl,progs/h2stuff/newfire.mdl"},
    // And one of Ironwail's.
    {"hudstyle", "0"},
};

}  // namespace

void add_quakespasm_cvars(Console& console) {
  for (const Row& row : kRows) {
    if (console.find_cvar(row.name) || console.has_command(row.name)) continue;
    console.add_cvar(row.name, row.value, fmt::format("{}; no effect here: {}", row.what, row.why),
                     kCvarNoEffect | (row.archived ? kCvarArchive : kCvarPlain));
  }
  for (const Setting& setting : kPlayersSettings) {
    if (console.find_cvar(setting.name) || console.has_command(setting.name)) continue;
    console.add_cvar(setting.name, setting.value,
                     "a player's setting, for mods; no effect here: no player looks through it", kCvarNoEffect);
  }
}

}  // namespace fb::con
