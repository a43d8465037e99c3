// What changes how a level behaves, for mods that ask whether it is there (checkextension): from then on, and for them
// alone. And commands of players that a mod hears first (KRIMZON_SV_PARSECLIENTCOMMAND).
#include "server/builtins/game_builtins.h"
#include "server/clients/client_commands.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::Vm;

constexpr std::string_view kRotating = "DP_SV_ROTATINGBMODEL", kSkinContents = "FTE_ENT_SKIN_CONTENTS";

// pr_checkextension 0: there are none.
void checkextension(Vm& vm, const GameContext& context) {
  const std::string_view name = vm.parm_string(0);
  const bool yes = !vm.failed() && context.clients.extensions_wanted() && vm.builtins().has_extension(name);
  if (yes && context.level) {
    context.level->asked.rotating_pushers |= name == kRotating;
    context.level->asked.skin_contents |= name == kSkinContents;
  }
  vm.return_float(yes ? 1.0f : 0.0f);
}

// clientcommand(player, text): as if the player had sent it, but for SV_ParseClientCommand.
void clientcommand(Vm& vm, const GameContext& context) {
  ServerClient* client = context.clients.find(vm.parm_entity(0));
  const std::string text(vm.parm_string(1));
  if (!vm.failed() && client && client->active()) context.clients.execute_command(*client, text);
}

}  // namespace

void add_extension_builtins(BuiltinTable& table, GameContext& context) {
  table.set(99, "checkextension", [&context](Vm& vm) { checkextension(vm, context); });
  table.set(440, "clientcommand", [&context](Vm& vm) { clientcommand(vm, context); });
  for (const std::string_view name : {kRotating, kSkinContents, std::string_view("KRIMZON_SV_PARSECLIENTCOMMAND")})
    table.add_extension(name);
}

}  // namespace fb::sv
