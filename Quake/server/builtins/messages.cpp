// What QuakeC says to players, and the bytes that it writes itself.
#include <fmt/format.h>

#include "base/log.h"
#include "console/localization.h"
#include "progs/builtins/output.h"
#include "server/builtins/game_builtins.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::message_text;
using progs::Vm;
namespace globals = progs::globals;

// Whose entity parameter 0 is; null, with a line in the log, where it is no player's.
ServerClient* client_parm(Vm& vm, GameContext& context, std::string_view what) {
  const EdictId id = vm.parm_entity(0);
  if (vm.failed()) return nullptr;
  ServerClient* client = context.clients.find(id);
  if (!client) log_info("{} to entity {}, which is no player", what, index(id));
  return client;
}

// sound(entity, channel, sample, volume, attenuation)
void sound(Vm& vm, GameContext& context) {
  const EdictId source = vm.parm_entity(0);
  const std::int32_t channel = vm.parm_int(1);
  const std::string sample(vm.parm_string(2));
  const float volume = vm.parm_float(3), attenuation = vm.parm_float(4);
  if (vm.failed()) return;
  const std::int32_t byte = progs::to_int(volume * 255.0f);
  if (byte < 0 || byte > 255) return vm.fail(fmt::format("sound {}: volume {}, of 0 to 1", sample, volume));
  if (!(attenuation >= 0.0f && attenuation <= 4.0f))
    return vm.fail(fmt::format("sound {}: attenuation {}, of 0 to 4", sample, attenuation));
  if (channel < 0 || channel > 7) return vm.fail(fmt::format("sound {}: channel {}, of 0 to 7", sample, channel));
  context.clients.start_sound(source, channel, sample, volume, attenuation);
}

// ambientsound(position, sample, volume, attenuation)
void ambientsound(Vm& vm, GameContext& context) {
  const std::string_view sample = vm.parm_string(1);
  if (!vm.failed()) context.clients.ambient_sound(vm.parm_vector(0), sample, vm.parm_float(2), vm.parm_float(3));
}

// localsound(client, sample): the 2021 re-release's
void localsound(Vm& vm, GameContext& context) {
  ServerClient* client = client_parm(vm, context, "localsound");
  const std::string_view sample = vm.parm_string(1);
  if (!vm.failed() && client && client->active()) context.clients.local_sound(*client, sample);
}

// stuffcmd(client, text)
void stuffcmd(Vm& vm, GameContext& context) {
  const EdictId id = vm.parm_entity(0);
  const std::string_view text = vm.parm_string(1);
  if (vm.failed()) return;
  ServerClient* client = context.clients.find(id);
  if (!client) return vm.fail(fmt::format("stuffcmd to entity {}, which is no player", index(id)));
  if (client->active()) context.clients.stuff(*client, text);
}

// lightstyle(style, pattern)
void lightstyle(Vm& vm, GameContext& context) {
  const std::int32_t style = vm.parm_int(0);
  const std::string_view pattern = vm.parm_string(1);
  if (vm.failed()) return;
  if (style < 0 || style >= net::kMaxLightStyles)
    return log_warning("lightstyle {}, of 0 to {}", style, net::kMaxLightStyles - 1);
  context.clients.light_style(style, pattern);
}

// particle(origin, direction, color, count)
void particle(Vm& vm, GameContext& context) {
  context.clients.start_particle(vm.parm_vector(0), vm.parm_vector(1), vm.parm_int(2), vm.parm_int(3));
}

// setspawnparms(client): what it came to the level with into parm1 ...
void setspawnparms(Vm& vm, GameContext& context) {
  const EdictId id = vm.parm_entity(0);
  if (vm.failed()) return;
  const ServerClient* client = context.clients.find(id);
  if (!client) return vm.fail(fmt::format("setspawnparms of entity {}, which is no player", index(id)));
  for (std::uint32_t i = 0; i < globals::kSpawnParms; ++i) vm.set(globals::spawn_parm(i), client->spawn_parms.at(i));
}

// makestatic(entity): goes to the clients for good; invisible ones go nowhere (QuakeSpasm).
void makestatic(Vm& vm, GameContext& context) {
  const EdictId id = vm.parm_entity(0);
  if (vm.failed()) return;
  if (context.level->extra(id).alpha != net::kAlphaZero) context.clients.make_static(vm.edict(id));
  vm.edicts().free(id, vm.level_time);
}

// WriteXxx(destination, value): calls `write` with where it goes.
template <typename Write>
void add_write(BuiltinTable& table, GameContext& context, std::uint32_t number, std::string_view name, Write write) {
  table.set(number, name, [&context, write](Vm& vm) {
    const auto writer = context.clients.destination(vm.parm_int(0), vm.get(globals::msg_entity));
    if (!writer) return vm.fail(writer.error().message);
    write(**writer, vm);
  });
}

void add_writes(BuiltinTable& table, GameContext& context) {
  using net::MessageWriter;
  add_write(table, context, 52, "WriteByte", [](MessageWriter& to, Vm& vm) { to.u8(vm.parm_int(1)); });
  add_write(table, context, 53, "WriteChar", [](MessageWriter& to, Vm& vm) { to.i8(vm.parm_int(1)); });
  add_write(table, context, 54, "WriteShort", [](MessageWriter& to, Vm& vm) { to.i16(vm.parm_int(1)); });
  add_write(table, context, 55, "WriteLong", [](MessageWriter& to, Vm& vm) { to.i32(vm.parm_int(1)); });
  add_write(table, context, 56, "WriteCoord", [](MessageWriter& to, Vm& vm) { to.coord(vm.parm_float(1)); });
  add_write(table, context, 57, "WriteAngle", [](MessageWriter& to, Vm& vm) { to.angle(vm.parm_float(1)); });
  add_write(table, context, 58, "WriteString", [&context](MessageWriter& to, Vm& vm) {
    const std::string_view text = vm.parm_string(1);
    to.string(context.localization ? context.localization->text(text) : text);
  });
  add_write(table, context, 59, "WriteEntity", [](MessageWriter& to, Vm& vm) {
    const EdictId id = vm.parm_entity(1);
    if (!vm.failed()) to.u16(static_cast<int>(index(id)));
  });
}

}  // namespace

void add_message_builtins(BuiltinTable& table, GameContext& context) {
  const auto set = [&](std::uint32_t number, std::string_view name, void (*builtin)(Vm&, GameContext&)) {
    table.set(number, name, [&context, builtin](Vm& vm) { builtin(vm, context); });
  };
  set(8, "sound", sound);
  set(21, "stuffcmd", stuffcmd);
  set(23, "bprint", [](Vm& vm, GameContext& in) { in.clients.broadcast_print(message_text(vm, 0, in.localization)); });
  set(24, "sprint", [](Vm& vm, GameContext& in) {
    ServerClient* client = client_parm(vm, in, "sprint");
    if (client && client->active()) in.clients.print(*client, message_text(vm, 1, in.localization));
  });
  set(73, "centerprint", [](Vm& vm, GameContext& in) {
    ServerClient* client = client_parm(vm, in, "centerprint");
    if (client && client->active()) in.clients.center_print(*client, message_text(vm, 1, in.localization));
  });
  set(35, "lightstyle", lightstyle);
  set(48, "particle", particle);
  set(69, "makestatic", makestatic);
  set(74, "ambientsound", ambientsound);
  set(80, "localsound", localsound);
  set(78, "setspawnparms", setspawnparms);
  add_writes(table, context);
}

}  // namespace fb::sv
