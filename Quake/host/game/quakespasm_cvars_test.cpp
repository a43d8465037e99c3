// QuakeSpasm's cvars, as its cvarlist has them where no configuration was read, against all of ours.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "base/number.h"
#include "base/test_directory.h"
#include "host/game/engine.h"
#include "host/game/key_router.h"
#include "host/game/menu_facts.h"
#include "host/game/screen.h"

namespace fb::host {
namespace {

struct Theirs {
  const char* name;
  const char* value;
};
// 0.96.3; but for cmdline, which is as QuakeSpasm was started.
constexpr Theirs kTheirCvars[] = {
    {"_cl_color", "0"},
    {"_cl_name", "player"},
    {"_snd_mixahead", "0.1"},
    {"ambient_fade", "100"},
    {"ambient_level", "0.3"},
    {"bgm_extmusic", "1"},
    {"bgmvolume", "1"},
    {"campaign", "0"},
    {"cfg_unbindall", "1"},
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
    {"cl_gun_fovscale", "1"},
    {"cl_maxpitch", "90"},
    {"cl_minpitch", "-90"},
    {"cl_movespeedkey", "2.0"},
    {"cl_nolerp", "0"},
    {"cl_pitchspeed", "150"},
    {"cl_rollangle", "2.0"},
    {"cl_rollspeed", "200"},
    {"cl_shownet", "0"},
    {"cl_sidespeed", "350"},
    {"cl_startdemos", "1"},
    {"cl_upspeed", "200"},
    {"cl_yawspeed", "140"},
    {"con_logcenterprint", "1"},
    {"con_notifytime", "3"},
    {"contrast", "1"},
    {"coop", "0"},
    {"crosshair", "0"},
    {"deathmatch", "0"},
    {"developer", "0"},
    {"devstats", "0"},
    {"edgefriction", "2"},
    {"external_ents", "1"},
    {"external_vis", "1"},
    {"fov", "90"},
    {"fov_adapt", "1"},
    {"fraglimit", "0"},
    {"gamecfg", "0"},
    {"gamma", "1"},
    {"gl_affinemodels", "0"},
    {"gl_clear", "1"},
    {"gl_cshiftpercent", "100"},
    {"gl_cshiftpercent_bonus", "100"},
    {"gl_cshiftpercent_contents", "100"},
    {"gl_cshiftpercent_damage", "100"},
    {"gl_cshiftpercent_powerup", "100"},
    {"gl_cull", "1"},
    {"gl_farclip", "65536"},
    {"gl_finish", "0"},
    {"gl_flashblend", "0"},
    {"gl_fullbrights", "1"},
    {"gl_max_size", "0"},
    {"gl_nocolors", "0"},
    {"gl_overbright", "1"},
    {"gl_overbright_models", "1"},
    {"gl_picmip", "0"},
    {"gl_playermip", "0"},
    {"gl_polyblend", "1"},
    {"gl_smoothmodels", "1"},
    {"gl_subdivide_size", "128"},
    {"gl_texture_anisotropy", "1"},
    {"gl_texturemode", "GL_LINEAR_MIPMAP_LINEAR"},
    {"gl_triplebuffer", "1"},
    {"gl_zfix", "0"},
    {"horde", "0"},
    {"host_framerate", "0"},
    {"host_maxfps", "72"},
    {"host_speeds", "0"},
    {"host_timescale", "0"},
    {"hostname", "UNNAMED"},
    {"in_debugkeys", "0"},
    {"joy_deadzone_look", "0.175"},
    {"joy_deadzone_move", "0.175"},
    {"joy_deadzone_trigger", "0.2"},
    {"joy_enable", "1"},
    {"joy_exponent", "2"},
    {"joy_exponent_move", "2"},
    {"joy_invert", "0"},
    {"joy_outer_threshold_look", "0.02"},
    {"joy_outer_threshold_move", "0.02"},
    {"joy_sensitivity_pitch", "130"},
    {"joy_sensitivity_yaw", "240"},
    {"joy_swapmovelook", "0"},
    {"loadas8bit", "0"},
    {"lookspring", "0"},
    {"lookstrafe", "0"},
    {"m_forward", "1"},
    {"m_pitch", "0.022"},
    {"m_side", "0.8"},
    {"m_yaw", "0.022"},
    {"max_edicts", "8192"},
    {"net_messagetimeout", "300"},
    {"noexit", "0"},
    {"nomonsters", "0"},
    {"nosound", "0"},
    {"pausable", "1"},
    {"precache", "1"},
    {"r_clearcolor", "2"},
    {"r_drawentities", "1"},
    {"r_drawflat", "0"},
    {"r_drawviewmodel", "1"},
    {"r_drawworld", "1"},
    {"r_dynamic", "1"},
    {"r_fastsky", "0"},
    {"r_flatlightstyles", "0"},
    {"r_fullbright", "0"},
    {"r_lavaalpha", "0"},
    {"r_lerpmodels", "1"},
    {"r_lerpmove", "1"},
    {"r_lightmap", "0"},
    {"r_lightmapwide", "1"},
    {"r_litwater", "1"},
    {"r_nolerp_list",
     "progs/flame.mdl,progs/flame2.mdl,progs/braztall.mdl,progs/brazshrt.mdl,progs/longtrch.mdl,progs/"
     "flame_pyre.mdl,progs/v_saw.mdl,progs/v_xfist.mdl,progs/h2stuff/newfire.mdl"},
    {"r_norefresh", "0"},
    {"r_noshadow_list",
     "progs/flame2.mdl,progs/flame.mdl,progs/bolt1.mdl,progs/bolt2.mdl,progs/bolt3.mdl,progs/laser.mdl"},
    {"r_novis", "0"},
    {"r_oldskyleaf", "0"},
    {"r_oldwater", "0"},
    {"r_particles", "1"},
    {"r_pos", "0"},
    {"r_quadparticles", "1"},
    {"r_scale", "1"},
    {"r_shadows", "0"},
    {"r_showbboxes", "0"},
    {"r_showtris", "0"},
    {"r_sky_quality", "12"},
    {"r_skyalpha", "1"},
    {"r_skyfog", "0.5"},
    {"r_slimealpha", "0"},
    {"r_speeds", "0"},
    {"r_stereo", "0"},
    {"r_stereodepth", "128"},
    {"r_telealpha", "0"},
    {"r_viewmodel_quake", "0"},
    {"r_wateralpha", "1"},
    {"r_waterquality", "8"},
    {"r_waterwarp", "1"},
    {"registered", "1"},
    {"samelevel", "0"},
    {"saved1", "0"},
    {"saved2", "0"},
    {"saved3", "0"},
    {"saved4", "0"},
    {"savedgamecfg", "0"},
    {"scr_centertime", "2"},
    {"scr_clock", "0"},
    {"scr_conalpha", "0.5"},
    {"scr_conscale", "1"},
    {"scr_conspeed", "500"},
    {"scr_conwidth", "0"},
    {"scr_crosshairscale", "1"},
    {"scr_menuscale", "1"},
    {"scr_ofsx", "0"},
    {"scr_ofsy", "0"},
    {"scr_ofsz", "0"},
    {"scr_printspeed", "8"},
    {"scr_sbaralpha", "0.75"},
    {"scr_sbarscale", "1"},
    {"scr_showfps", "0"},
    {"scr_usekfont", "0"},
    {"scratch1", "0"},
    {"scratch2", "0"},
    {"scratch3", "0"},
    {"scratch4", "0"},
    {"sensitivity", "3"},
    {"serverprofile", "0"},
    {"showpause", "1"},
    {"showturtle", "0"},
    {"skill", "1"},
    {"snd_filterquality", "1"},
    {"snd_mixspeed", "44100"},
    {"snd_noextraupdate", "0"},
    {"snd_show", "0"},
    {"sndspeed", "11025"},
    {"sv_accelerate", "10"},
    {"sv_aim", "1"},
    {"sv_altnoclip", "1"},
    {"sv_cheats", "0"},
    {"sv_fishfix", "1"},
    {"sv_freezenonclients", "0"},
    {"sv_friction", "4"},
    {"sv_gravity", "800"},
    {"sv_idealpitchscale", "0.8"},
    {"sv_maxspeed", "320"},
    {"sv_maxvelocity", "2000"},
    {"sv_nostep", "0"},
    {"sv_stopspeed", "100"},
    {"sys_throttle", "0.02"},
    {"sys_ticrate", "0.05"},
    {"teamplay", "0"},
    {"temp1", "0"},
    {"timelimit", "0"},
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
    {"vid_borderless", "0"},
    {"vid_bpp", "24"},
    {"vid_desktopfullscreen", "0"},
    {"vid_fsaa", "2"},
    {"vid_fullscreen", "0"},
    {"vid_height", "600"},
    {"vid_refreshrate", "60"},
    {"vid_vsync", "0"},
    {"vid_width", "800"},
    {"viewsize", "100"},
    {"volume", "0.7"},
};

// Ours differ, for a reason.
const std::map<std::string_view, const char*> kOurs = {
    {"host_maxfps", "250"},   // above 72 the game ticks at 72 all the same
    {"max_edicts", "32000"},  // QuakeSpasm's most
    {"r_waterwarp", "-1"},    // as 1, but where water refracts
    {"registered", "0"},      // a folder without id's data
};

class QuakeSpasmCvarsTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(directory.path() / "id1");
    auto made = Engine::create({"-basedir", directory.path().string(), "-nohome", "-nolan"});
    ASSERT_TRUE(made.ok()) << made.error().message;
    engine = std::move(*made);
    facts = std::make_unique<MenuFacts>(*engine);
    keys = std::make_unique<KeyRouter>(engine->console(), *facts);
    screen = std::make_unique<Screen>(engine->console(), csqc::ModHudServices{.read_file = engine->files().loader()},
                                      *keys, engine->rules());
  }
  const TestDirectory directory;
  std::unique_ptr<Engine> engine;
  std::unique_ptr<MenuFacts> facts;
  std::unique_ptr<KeyRouter> keys;
  std::unique_ptr<Screen> screen;  // which has cvars, too
};

TEST_F(QuakeSpasmCvarsTest, AreThereWithTheirDefaults) {
  for (const Theirs& theirs : kTheirCvars) {
    const con::Cvar* cvar = engine->console().find_cvar(theirs.name);
    ASSERT_NE(cvar, nullptr) << theirs.name;
    const auto ours = kOurs.find(theirs.name);
    const std::string wanted = ours == kOurs.end() ? theirs.value : ours->second;
    const auto number = parse_number(wanted);
    const bool same = number ? parse_number(cvar->default_string()) == number : cvar->default_string() == wanted;
    EXPECT_TRUE(same) << theirs.name << " is " << cvar->default_string() << " and should be " << wanted;
    EXPECT_FALSE(cvar->spec().help.empty()) << theirs.name;
  }
  EXPECT_EQ(engine->console().cvar("cmdline").string(), "-basedir " + directory.path().string() + " -nohome -nolan");
}

// Mods ask for settings of players wherever they run.
TEST_F(QuakeSpasmCvarsTest, ADedicatedServerHasThemAll) {
  EngineOptions options;
  options.client = false;
  options.dedicated = true;
  auto made = Engine::create({"-basedir", directory.path().string(), "-nohome", "-nolan"}, options);
  ASSERT_TRUE(made.ok()) << made.error().message;
  for (const Theirs& theirs : kTheirCvars) EXPECT_NE((*made)->console().find_cvar(theirs.name), nullptr) << theirs.name;
  EXPECT_NE((*made)->console().find_cvar("hudstyle"), nullptr);
  EXPECT_NE(engine->console().find_cvar("hudstyle"), nullptr) << "nor is it a stranger where there is a client";
}

TEST_F(QuakeSpasmCvarsTest, AConfigurationOfTheirsSetsThemWithoutAWord) {
  std::string config;
  for (const Theirs& theirs : kTheirCvars) {
    if (std::string_view(theirs.name) != "registered")
      config += std::string(theirs.name) + " \"" + theirs.value + "\"\n";
  }
  std::string said;
  const int listener = add_log_listener([&](LogLevel, std::string_view line) { said += std::string(line) + "\n"; });
  engine->console().execute(config);
  remove_log_listener(listener);
  EXPECT_EQ(said, "");
  EXPECT_EQ(engine->console().cvar("host_maxfps").integer(), 72);
}

TEST_F(QuakeSpasmCvarsTest, OurOwnConfigurationHoldsNoStrangers) {
  const std::string config = engine->console().config_text();
  for (const con::Cvar* cvar : engine->console().cvars()) {
    const bool there = ("\n" + config).find("\n" + cvar->name() + " ") != std::string::npos;
    EXPECT_EQ(there, cvar->archived() && cvar->has_effect()) << cvar->name();
  }
}

}  // namespace
}  // namespace fb::host
