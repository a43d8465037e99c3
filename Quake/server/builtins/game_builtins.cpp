#include "server/builtins/game_builtins.h"

namespace fb::sv {

void add_game_builtins(progs::BuiltinTable& table, GameContext& context) {
  add_world_builtins(table, context);
  add_sight_builtins(table, context);
  add_message_builtins(table, context);
  add_level_builtins(table, context);
  add_effect_builtins(table, context);
  add_surface_builtins(table, context);
  add_extension_builtins(table, context);
  table.add_extension("DP_GFX_FOG");  // the client's, of the world's key `fog`
}

}  // namespace fb::sv
