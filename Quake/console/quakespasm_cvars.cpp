#include "console/quakespasm_cvars.h"

#include <fmt/format.h>

namespace fb::con {
namespace {

constexpr const char* kSound = "there is no sound yet";
constexpr const char* kPad = "there are no game controllers yet";
constexpr const char* kHud = "there are no menus and no status bar yet";
constexpr const char* kConsole = "the console and its notify lines have one look";
constexpr const char* kTracer = "the path tracer has nothing of the kind";
constexpr const char* kVideo = "the command line sets up the window";
constexpr const char* kDiagnosis = "it diagnoses QuakeSpasm itself";
constexpr const char* kAlways = "it is always so";
constexpr const char* kLiquids = "a map says itself how clear its liquids are";

struct Row {
  const char* name;
  const char* value;
  bool archived;  // by QuakeSpasm
  const char* what;
  const char* why;  // there is no effect
};
constexpr Row kRows[] = {
    {"_snd_mixahead", "0.1", true, "seconds of sound mixed ahead", kSound},
    {"ambient_fade", "100", false, "how fast ambient sounds of liquids and sky swell", kSound},
    {"ambient_level", "0.3", false, "volume of ambient sounds of liquids and sky", kSound},
    {"bgm_extmusic", "1", true, "music from files instead of a disc", kSound},
    {"bgmvolume", "1", true, "volume of the music", kSound},
    {"nosound", "0", false, "1: no sound", kSound},
    {"precache", "1", false, "sounds are loaded when a level begins", kSound},
    {"loadas8bit", "0", false, "sounds are kept in 8 bits", kSound},
    {"snd_filterquality", "1", false, "quality of sounds' resampling", kSound},
    {"snd_mixspeed", "44100", false, "rate that sounds are mixed at, Hz", kSound},
    {"snd_noextraupdate", "0", false, "1: sound is not mixed while a frame is drawn", kSound},
    {"snd_show", "0", false, "shows which sounds are heard", kSound},
    {"sndspeed", "11025", false, "rate that sounds are loaded at, Hz", kSound},
    {"volume", "0.7", true, "volume of sounds", kSound},
    {"joy_deadzone", "0.175", true, "dead part of both sticks, until QuakeSpasm 0.95", kPad},
    {"joy_deadzone_look", "0.175", true, "dead part of the stick that looks", kPad},
    {"joy_deadzone_move", "0.175", true, "dead part of the stick that walks", kPad},
    {"joy_deadzone_trigger", "0.2", true, "dead part of the triggers", kPad},
    {"joy_enable", "1", true, "whether game controllers count", kPad},
    {"joy_exponent", "2", true, "curve of the stick that looks", kPad},
    {"joy_exponent_move", "2", true, "curve of the stick that walks", kPad},
    {"joy_invert", "0", true, "the stick looks up and down the other way round", kPad},
    {"joy_outer_threshold_look", "0.02", true, "outermost part of the stick that looks, which counts as its end", kPad},
    {"joy_outer_threshold_move", "0.02", true, "the same of the stick that walks", kPad},
    {"joy_sensitivity_pitch", "130", true, "how fast the stick looks up and down, degrees a second", kPad},
    {"joy_sensitivity_yaw", "240", true, "how fast the stick turns, degrees a second", kPad},
    {"joy_swapmovelook", "0", true, "swaps the sticks", kPad},
    {"crosshair", "0", true, "a mark in the picture's middle", kHud},
    {"scr_centertime", "2", false, "seconds that a message stays in the middle", kHud},
    {"scr_clock", "0", false, "shows the level's time", kHud},
    {"scr_crosshairscale", "1", true, "size of the crosshair", kHud},
    {"scr_menuscale", "1", true, "size of the menus", kHud},
    {"scr_printspeed", "8", false, "letters a second of the texts between episodes", kHud},
    {"scr_sbaralpha", "0.75", true, "opacity of the status bar", kHud},
    {"scr_sbarscale", "1", true, "size of the status bar", kHud},
    {"showpause", "1", false, "shows that the game is paused", kHud},
    {"showturtle", "0", false, "shows that frames are slow", kHud},
    {"con_logcenterprint", "1", false, "messages in the middle go to the console, too", kConsole},
    {"con_notifytime", "3", false, "seconds that lines stay on top of the game", kConsole},
    {"scr_conalpha", "0.5", true, "opacity of the console", kConsole},
    {"scr_conscale", "1", true, "size of the console's letters", kConsole},
    {"scr_conspeed", "500", true, "how fast the console comes down", kConsole},
    {"scr_conwidth", "0", true, "width of the console", kConsole},
    {"scr_usekfont", "0", false, "the re-release's letters", kConsole},
    {"cl_gun_fovscale", "1", true, "the weapon in hand is not stretched by a wide field of view", kTracer},
    {"contrast", "1", true, "contrast of the picture (r_exposure and r_tonemap set it here)", kTracer},
    {"gamma", "1", true, "gamma of the picture (r_exposure and r_tonemap set it here)", kTracer},
    {"gl_affinemodels", "0", false, "textures of models without perspective", kTracer},
    {"gl_clear", "1", false, "clears the picture before each frame", kTracer},
    {"gl_cull", "1", false, "leaves out what faces away", kTracer},
    {"gl_farclip", "65536", true, "distance behind which nothing is drawn", kTracer},
    {"gl_finish", "0", false, "waits for the GPU after each frame", kTracer},
    {"gl_flashblend", "0", true, "moving lights as coloured balls", kTracer},
    {"gl_fullbrights", "1", true, "fullbright texels are bright (r_emit_fullbright sets how bright here)", kTracer},
    {"gl_max_size", "0", false, "largest texture", kTracer},
    {"gl_nocolors", "0", false, "players without their colours", kTracer},
    {"gl_overbright", "1", true, "lightmaps may brighten textures", kTracer},
    {"gl_overbright_models", "1", true, "light may brighten models' textures", kTracer},
    {"gl_picmip", "0", false, "coarser textures", kTracer},
    {"gl_playermip", "0", false, "coarser textures of players", kTracer},
    {"gl_smoothmodels", "1", false, "smooth shading of models", kTracer},
    {"gl_subdivide_size", "128", true, "size of the pieces that liquids are cut into", kTracer},
    {"gl_texture_anisotropy", "1", true, "anisotropic filtering of textures", kTracer},
    {"gl_texturemode", "GL_LINEAR_MIPMAP_LINEAR", true, "filtering of textures (r_texture_filter sets it here)",
     kTracer},
    {"gl_triplebuffer", "1", true, "three buffers for the picture", kTracer},
    {"gl_zfix", "0", false, "moves doors and lifts a little, against flickering", kTracer},
    {"r_clearcolor", "2", true, "colour of the picture where nothing is drawn", kTracer},
    {"r_drawflat", "0", false, "draws every surface in one colour", kTracer},
    {"r_fastsky", "0", false, "the sky in one colour", kTracer},
    {"r_flatlightstyles", "0", false, "lights that do not flicker", kTracer},
    {"r_fullbright", "0", false, "everything lit evenly", kTracer},
    {"r_lavaalpha", "0", false, "opacity of lava", kLiquids},
    {"r_lightmap", "0", false, "shows lightmaps alone", kTracer},
    {"r_lightmapwide", "1", false, "lightmaps of 10 bits a colour", kTracer},
    {"r_litwater", "1", false, "lightmaps on liquids", kTracer},
    {"r_norefresh", "0", false, "draws nothing", kTracer},
    {"r_noshadow_list",
     "progs/flame2.mdl,progs/flame.mdl,progs/bolt1.mdl,progs/bolt2.mdl,progs/bolt3.mdl,progs/laser.mdl", false,
     "models that r_shadows leaves out", kTracer},
    {"r_novis", "0", true, "draws what the map's visibility leaves out, too", kTracer},
    {"r_oldskyleaf", "0", false, "visibility of the sky as in GLQuake", kTracer},
    {"r_oldwater", "0", true, "liquids that wobble as in GLQuake", kTracer},
    {"r_quadparticles", "1", true, "particles of four corners", kTracer},
    {"r_shadows", "0", true, "models throw a flat shadow (they throw real ones here)", kTracer},
    {"r_sky_quality", "12", false, "how finely the sky is cut", kTracer},
    {"r_skyalpha", "1", false, "opacity of the sky's clouds", kTracer},
    {"r_skyfog", "0.5", false, "how much fog hides the sky", kTracer},
    {"r_slimealpha", "0", false, "opacity of slime", kLiquids},
    {"r_stereo", "0", false, "pictures for both eyes", kTracer},
    {"r_stereodepth", "128", false, "depth of these", kTracer},
    {"r_telealpha", "0", false, "opacity of teleporters", kLiquids},
    {"r_wateralpha", "1", true, "opacity of water", kLiquids},
    {"r_waterquality", "8", false, "how finely liquids wobble", kTracer},
    {"r_waterwarp", "1", false, "the picture wobbles under water", kTracer},
    {"r_showbboxes", "0", false, "shows the boxes of things", kTracer},
    {"r_showtris", "0", false, "shows triangles", kTracer},
    {"vid_borderless", "0", true, "a window without a frame", kVideo},
    {"vid_bpp", "24", true, "bits a pixel", kVideo},
    {"vid_desktopfullscreen", "0", true, "a full screen keeps the display's mode", kVideo},
    {"vid_fsaa", "2", true, "samples a pixel (r_fxaa and r_taa smooth edges here)", kVideo},
    {"vid_fullscreen", "0", true, "a full screen", kVideo},
    {"vid_height", "600", true, "height of the picture", kVideo},
    {"vid_refreshrate", "60", true, "pictures a second of the display", kVideo},
    {"vid_vsync", "0", true, "waits for the display's refresh", kVideo},
    {"vid_width", "800", true, "width of the picture", kVideo},
    {"cl_shownet", "0", false, "prints what arrives from the server", kDiagnosis},
    {"devstats", "0", false, "shows what the level takes", kDiagnosis},
    {"host_speeds", "0", false, "prints what parts of a frame take", kDiagnosis},
    {"in_debugkeys", "0", false, "prints keys as they are pressed", kDiagnosis},
    {"r_pos", "0", false, "prints where the player is", kDiagnosis},
    {"r_speeds", "0", false, "prints what drawing a frame takes", kDiagnosis},
    {"scr_showfps", "0", false, "shows the frames a second", kDiagnosis},
    {"serverprofile", "0", false, "prints what the server takes", kDiagnosis},
    {"cfg_unbindall", "1", true, "config.cfg begins with unbindall", kAlways},
    {"external_ents", "1", true, "a map's entities come from its .ent file, where it has one", kAlways},
    {"external_vis", "1", true, "a map's visibility comes from its .vis file, where it has one", kAlways},
    {"sv_fishfix", "1", true, "fish of id's game count as one monster, not two", "the game's own count stands"},
    {"sys_throttle", "0.02", true, "seconds that an idle frame sleeps", "frames sleep until they are due"},
    {"sys_ticrate", "0.05", false, "seconds of a dedicated server's tick", "this is no dedicated server"},
};

}  // namespace

void add_quakespasm_cvars(Console& console) {
  for (const Row& row : kRows) {
    if (console.find_cvar(row.name) || console.has_command(row.name)) continue;
    console.add_cvar(row.name, row.value, fmt::format("{}; no effect here: {}", row.what, row.why),
                     kCvarNoEffect | (row.archived ? kCvarArchive : kCvarPlain));
  }
}

}  // namespace fb::con
