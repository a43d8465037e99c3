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
#define FB_CLIENT_CVARS(X)                                                                         \
  X(fov, "fov", 90.0f, "horizontal field of view of a 4:3 picture, degrees")                       \
  X(fov_adapt, "fov_adapt", 1.0f, "wider pictures see more to the sides")                          \
  X(cl_nolerp, "cl_nolerp", 0.0f, "1: entities jump from message to message")                      \
  X(r_lerpmodels, "r_lerpmodels", 1.0f, "blend alias poses; 2: also those of r_nolerp_list")       \
  X(r_lerpmove, "r_lerpmove", 1.0f, "smooth the steps of monsters")                                \
  X(cl_rollspeed, "cl_rollspeed", 200.0f, "sideways speed of the full roll")                       \
  X(cl_rollangle, "cl_rollangle", 2.0f, "roll when moving sideways, degrees")                      \
  X(cl_bob, "cl_bob", 0.02f, "height of the walk's bob")                                           \
  X(cl_bobcycle, "cl_bobcycle", 0.6f, "seconds of one bob")                                        \
  X(cl_bobup, "cl_bobup", 0.5f, "share of the bob that goes up")                                   \
  X(v_kicktime, "v_kicktime", 0.5f, "seconds that damage tilts the view")                          \
  X(v_kickroll, "v_kickroll", 0.6f, "roll of that")                                                \
  X(v_kickpitch, "v_kickpitch", 0.6f, "pitch of that")                                             \
  X(v_gunkick, "v_gunkick", 1.0f, "0 none, 1 as the server says, 2 smoothly")                      \
  X(v_idlescale, "v_idlescale", 0.0f, "swaying of the view")                                       \
  X(v_iyaw_cycle, "v_iyaw_cycle", 2.0f, "its speed in yaw")                                        \
  X(v_iroll_cycle, "v_iroll_cycle", 0.5f, "in roll")                                               \
  X(v_ipitch_cycle, "v_ipitch_cycle", 1.0f, "in pitch")                                            \
  X(v_iyaw_level, "v_iyaw_level", 0.3f, "its size in yaw, degrees")                                \
  X(v_iroll_level, "v_iroll_level", 0.1f, "in roll")                                               \
  X(v_ipitch_level, "v_ipitch_level", 0.3f, "in pitch")                                            \
  X(scr_ofsx, "scr_ofsx", 0.0f, "the eye is moved forward by this (one player only)")              \
  X(scr_ofsy, "scr_ofsy", 0.0f, "to the right")                                                    \
  X(scr_ofsz, "scr_ofsz", 0.0f, "up")                                                              \
  X(chase_active, "chase_active", 0.0f, "look at the player from behind")                          \
  X(chase_back, "chase_back", 100.0f, "from so far behind")                                        \
  X(chase_up, "chase_up", 16.0f, "and so high")                                                    \
  X(chase_right, "chase_right", 0.0f, "and so far to the right")                                   \
  X(gl_cshiftpercent, "gl_cshiftpercent", 100.0f, "strength of the colours over the picture")      \
  X(gl_cshiftpercent_contents, "gl_cshiftpercent_contents", 100.0f, "of liquids")                  \
  X(gl_cshiftpercent_damage, "gl_cshiftpercent_damage", 100.0f, "of damage")                       \
  X(gl_cshiftpercent_bonus, "gl_cshiftpercent_bonus", 100.0f, "of things picked up")               \
  X(gl_cshiftpercent_powerup, "gl_cshiftpercent_powerup", 100.0f, "of powers")                     \
  X(gl_polyblend, "gl_polyblend", 1.0f, "0: no colours over the picture")                          \
  X(r_drawviewmodel, "r_drawviewmodel", 1.0f, "draw the weapon in hand")                           \
  X(r_viewmodel_quake, "r_viewmodel_quake", 0.0f, "hold it as high as Quake's screen size has it") \
  X(viewsize, "viewsize", 100.0f, "which screen size that is")                                     \
  X(r_drawentities, "r_drawentities", 1.0f, "draw what moves")                                     \
  X(r_drawworld, "r_drawworld", 1.0f, "draw the map")                                              \
  X(r_particles, "r_particles", 1.0f, "draw particles")                                            \
  X(r_dynamic, "r_dynamic", 1.0f, "draw dynamic lights")                                           \
  X(r_entlights, "r_entlights", 1.0f, "spheres that glow where a map has its lamps")               \
  X(r_ambient, "r_ambient", -1.0f, "even light: 1 shows textures as painted, -1 what a map needs") \
  X(r_playerbody, "r_playerbody", 1.0f, "the player's own body throws shadows and shows in mirrors")

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
