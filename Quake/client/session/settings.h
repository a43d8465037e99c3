// The client's cvars as plain numbers, read from the console once a frame, so that what uses them needs no console.
// Names and defaults are QuakeSpasm's where QuakeSpasm has them.
#pragma once

#include <string>
#include <vector>

#include "base/maths.h"

namespace fb::con {
class Console;
}

namespace fb::cl {

// One row a cvar: member, name, default, help.
#define FB_CLIENT_CVARS(X)                                                                                             \
  X(fov, "fov", 90.0f, "horizontal field of view of a 4:3 picture, degrees")                                           \
  X(fov_adapt, "fov_adapt", 1.0f, "1: wider pictures get a wider field of view")                                       \
  X(cl_nolerp, "cl_nolerp", 0.0f, "1: entities are not interpolated between the server's messages")                    \
  X(r_lerpmodels, "r_lerpmodels", 1.0f, "interpolation of model animation: 0 off, 1 on, 2 also for r_nolerp_list")     \
  X(r_lerpmove, "r_lerpmove", 1.0f, "1: interpolate the movement of monsters")                                         \
  X(cl_rollspeed, "cl_rollspeed", 200.0f, "sideways speed at which the view's roll is full, units a second")           \
  X(cl_rollangle, "cl_rollangle", 2.0f, "most roll of the view when moving sideways, degrees")                         \
  X(cl_bob, "cl_bob", 0.02f, "view bob: height, units for each unit a second of speed")                                \
  X(cl_bobcycle, "cl_bobcycle", 0.6f, "view bob: seconds of a cycle")                                                  \
  X(cl_bobup, "cl_bobup", 0.5f, "view bob: fraction of a cycle that goes up")                                          \
  X(v_kicktime, "v_kicktime", 0.5f, "damage kick: seconds that the view stays tilted")                                 \
  X(v_kickroll, "v_kickroll", 0.6f, "damage kick: factor on its roll")                                                 \
  X(v_kickpitch, "v_kickpitch", 0.6f, "damage kick: factor on its pitch")                                              \
  X(v_gunkick, "v_gunkick", 1.0f, "weapon kick: 0 off, 1 as the server sends it, 2 interpolated")                      \
  X(v_idlescale, "v_idlescale", 0.0f, "idle sway of the view: factor on its angles; 0 off")                            \
  X(v_iyaw_cycle, "v_iyaw_cycle", 2.0f, "idle sway: speed of yaw, radians a second")                                   \
  X(v_iroll_cycle, "v_iroll_cycle", 0.5f, "idle sway: speed of roll, radians a second")                                \
  X(v_ipitch_cycle, "v_ipitch_cycle", 1.0f, "idle sway: speed of pitch, radians a second")                             \
  X(v_iyaw_level, "v_iyaw_level", 0.3f, "idle sway: size of yaw, degrees")                                             \
  X(v_iroll_level, "v_iroll_level", 0.1f, "idle sway: size of roll, degrees")                                          \
  X(v_ipitch_level, "v_ipitch_level", 0.3f, "idle sway: size of pitch, degrees")                                       \
  X(scr_ofsx, "scr_ofsx", 0.0f, "moves the eye forward, units (one player only)")                                      \
  X(scr_ofsy, "scr_ofsy", 0.0f, "moves the eye to the right, units")                                                   \
  X(scr_ofsz, "scr_ofsz", 0.0f, "moves the eye up, units")                                                             \
  X(chase_active, "chase_active", 0.0f, "1: chase camera, behind the player")                                          \
  X(chase_back, "chase_back", 100.0f, "chase camera: distance behind the player, units")                               \
  X(chase_up, "chase_up", 16.0f, "chase camera: height above the player's eye, units")                                 \
  X(chase_right, "chase_right", 0.0f, "chase camera: distance to the right, units")                                    \
  X(gl_cshiftpercent, "gl_cshiftpercent", 100.0f, "strength of all colour shifts of the picture, percent")             \
  X(gl_cshiftpercent_contents, "gl_cshiftpercent_contents", 100.0f,                                                    \
    "strength of the colour shift in liquids, percent")                                                                \
  X(gl_cshiftpercent_damage, "gl_cshiftpercent_damage", 100.0f, "strength of the colour shift of damage, percent")     \
  X(gl_cshiftpercent_bonus, "gl_cshiftpercent_bonus", 100.0f, "strength of the colour shift of pickups, percent")      \
  X(gl_cshiftpercent_powerup, "gl_cshiftpercent_powerup", 100.0f, "strength of the colour shift of powerups, percent") \
  X(gl_polyblend, "gl_polyblend", 1.0f, "0: no colour shifts")                                                         \
  X(r_drawviewmodel, "r_drawviewmodel", 1.0f, "draw the view model (the weapon in hand)")                              \
  X(r_viewmodel_quake, "r_viewmodel_quake", 0.0f, "1: raise the view model by viewsize, as Quake did")                 \
  X(viewsize, "viewsize", 100.0f, "size of the screen: status bar, height of the view model")                          \
  X(r_drawentities, "r_drawentities", 1.0f, "draw entities")                                                           \
  X(r_drawworld, "r_drawworld", 1.0f, "draw the map")                                                                  \
  X(r_particles, "r_particles", 1.0f, "draw particles")                                                                \
  X(r_dynamic, "r_dynamic", 1.0f, "draw dynamic lights")                                                               \
  X(r_entlights, "r_entlights", 1.0f, "glowing spheres at the map's light entities: factor on their light, 0 none")    \
  X(r_authored, "r_authored", 1.0f,                                                                                    \
    "1: lights of maps with baked light are as strong as that says; 0: as the map's keys and textures say")            \
  X(r_enhancedmodels, "r_enhancedmodels", 1.0f,                                                                        \
    "1: .md5mesh and .md3 beside a model's .mdl stand in its place, from the next map on")                             \
  X(r_ambient, "r_ambient", -1.0f, "uniform ambient light: -1 as the map needs, 0 none, 1 shows plain textures")       \
  X(r_fog, "r_fog", 1.0f, "fog of the map and of the console's fog: factor on its density, 0 none")                    \
  X(r_fog_g, "r_fog_g", 0.4f, "how far ahead fog scatters light: -0.999 back, 0 evenly, 0.999 straight on")            \
  X(r_fog_alpha, "r_fog_alpha", 0.0f,                                                                                  \
    "alpha of Draine's phase function of fog, 0 to 100: 0 Henyey and Greenstein's; for droplets of a size see "        \
    "Jendersie and d'Eon 2023")                                                                                        \
  X(r_skyfog, "r_skyfog", 0.5f, "opacity of fog over the sky; a map's own counts until this is changed")               \
  X(r_wateralpha, "r_wateralpha", 1.0f,                                                                                \
    "opacity of water (r_water 1) where the map has no key wateralpha, 0 to 1: half of light is left after 256 units " \
    "over it")                                                                                                         \
  X(r_slimealpha, "r_slimealpha", 0.0f, "the same of slime, where the map has no key slimealpha; 0: as r_wateralpha")  \
  X(r_lavaalpha, "r_lavaalpha", 0.0f,                                                                                  \
    "opacity of lava (r_water 1) where the map has no key lavaalpha, as r_wateralpha, and the share of its surface "   \
    "that glows; 0: opaque")                                                                                           \
  X(r_telealpha, "r_telealpha", 0.0f, "the same of teleporters, where the map has no key telealpha; 0: opaque")        \
  X(r_playerbody, "r_playerbody", 1.0f, "the player's own body casts shadows and shows in reflections")

struct Settings {
#define FB_MEMBER(member, name, value, help) float member = value;
  FB_CLIENT_CVARS(FB_MEMBER)
#undef FB_MEMBER
  std::vector<std::string> nolerp_models = default_nolerp_models();
  static std::vector<std::string> default_nolerp_models();
};

extern const char* const kNoLerpModels;  // r_nolerp_list's default

// The names in a list separated by commas.
std::vector<std::string> split_names(const std::string& list);

}  // namespace fb::cl
