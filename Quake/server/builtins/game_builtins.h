// The builtins that need a level, for the table on top of progs' standard_builtins: what moves and looks through the
// world, what speaks to players, what precaches. Numbers as Quake's defs.qc and dpextensions.qc have them.
//
// What QuakeC hands over that makes no sense (a channel of 9, a box inside out, an entity that is none) is an error of
// QuakeC in one sentence, or, where QuakeSpasm goes on, a warning.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "progs/builtin_table.h"
#include "server/clients/clients.h"
#include "server/simulation/level.h"
#include "world/pvs.h"

namespace fb::sv {

// What the builtins of one server work on. Outlives the tables that it is given to.
struct GameContext {
  explicit GameContext(Clients& clients) : clients(clients) {}
  Clients& clients;
  Level* level = nullptr;                                       // that QuakeC runs in
  std::function<LevelModel(std::string_view name)> load_model;  // its box; files are read once
  std::function<void(std::string name)> change_level;
  const con::Localization* localization = nullptr;  // of what players read; none: texts stay as they are
  world::LeafSet check_pvs{0};                      // what the player that checkclient found last may see
};

// Appends to what the level has precached, where it is not yet: its number, or 0 where the list is full. While the
// level runs the players are told.
int add_model(GameContext& context, const std::string& name);
int add_sound(GameContext& context, const std::string& name);

void add_game_builtins(progs::BuiltinTable& table, GameContext& context);

// A file for each kind.
void add_world_builtins(progs::BuiltinTable& table, GameContext& context);      // setorigin, traceline, walkmove, ...
void add_sight_builtins(progs::BuiltinTable& table, GameContext& context);      // checkclient, findradius, aim
void add_message_builtins(progs::BuiltinTable& table, GameContext& context);    // sprint, sound, WriteByte, ...
void add_level_builtins(progs::BuiltinTable& table, GameContext& context);      // precache_model, changelevel, ...
void add_effect_builtins(progs::BuiltinTable& table, GameContext& context);     // te_explosion, ...
void add_surface_builtins(progs::BuiltinTable& table, GameContext& context);    // getsurfacepoint, ...
void add_extension_builtins(progs::BuiltinTable& table, GameContext& context);  // checkextension, clientcommand

}  // namespace fb::sv
