// What QuakeC says to players, and the bytes that it writes itself.
#include <fmt/format.h>

#include <cmath>

#include "console/localization.h"
#include "progs/builtins/output.h"
#include "server/builtins/game_builtins.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::message_text;
using progs::Vm;
namespace globals = progs::globals;

constexpr float kMostChannel = 255.0f;  // what a message holds; Quake itself has 0 to 7

// Whose entity parameter 0 is; null, with a warning, where it is no player's.
ServerClient* client_parm(Vm& vm, GameContext& context, std::string_view what) {
  const EdictId id = vm.parm_entity(0);
  if (vm.failed()) return nullptr;
  ServerClient* client = context.clients.find(id);
  if (!client) vm.warn(fmt::format("{} to entity {}, which is no player", what, index(id)));
  return client;
}

// What a sound cannot be is made the nearest that it can.
float within(Vm& vm, std::string_view sample, const char* what, float value, float most) {
  if (value >= 0.0f && value <= most) return value;
  vm.warn(fmt::format("sound {}: {} {}, of 0 to {}", sample, what, value, most));
  return value > most ? most : 0.0f;
}

// Asked before the engine is, which could not say whose fault it is.
bool is_precached(Vm& vm, const GameContext& context, std::string_view sample) {
  if (context.level->sound_index(sample) != 0) return true;
  vm.warn(fmt::format("the sound \"{}\" is not precached", sample));
  return false;
}

// sound(entity, channel, sample, volume, attenuation)
void sound(Vm& vm, GameContext& context) {
  const EdictId source = vm.parm_entity(0);
  const std::string sample(vm.parm_string(2));
  if (vm.failed() || !is_precached(vm, context, sample)) return;
  const auto channel = progs::to_int(within(vm, sample, "channel", std::trunc(vm.parm_float(1)), kMostChannel));
  const float volume = within(vm, sample, "volume", vm.parm_float(3), 1.0f);
  context.clients.start_sound(source, channel, sample, volume,
                              within(vm, sample, "attenuation", vm.parm_float(4), 4.0f));
}

// ambientsound(position, sample, volume, attenuation)
void ambientsound(Vm& vm, GameContext& context) {
  const std::string_view sample = vm.parm_string(1);
  if (vm.failed() || !is_precached(vm, context, sample)) return;
  context.clients.ambient_sound(vm.parm_vector(0), sample, vm.parm_float(2), vm.parm_float(3));
}

// localsound(client, sample): the 2021 re-release's
void localsound(Vm& vm, GameContext& context) {
  ServerClient* client = client_parm(vm, context, "localsound");
  const std::string_view sample = vm.parm_string(1);
  if (vm.failed() || !client || !is_precached(vm, context, sample)) return;
  if (client->active()) context.clients.local_sound(*client, sample);
}

// pointsound(position, sample, volume, attenuation): of nothing and nobody.
void pointsound(Vm& vm, GameContext& context) {
  const std::string sample(vm.parm_string(1));
  if (vm.failed() || !is_precached(vm, context, sample)) return;
  context.clients.sound_at(vm.parm_vector(0), EdictId::kWorld, 0, sample,
                           within(vm, sample, "volume", vm.parm_float(2), 1.0f),
                           within(vm, sample, "attenuation", vm.parm_float(3), 4.0f));
}

// dropclient(player): once this frame's messages go.
void dropclient(Vm& vm, GameContext& context) {
  ServerClient* client = client_parm(vm, context, "dropclient");
  if (client && client->active()) client->sent_away = true;
}

// clienttype(entity): 0 a player's place where nobody is, 1 a player, 3 anything else. (2 is a bot: there are none.)
void clienttype(Vm& vm, GameContext& context) {
  const EdictId id = vm.parm_entity(0);
  const ServerClient* client = vm.failed() ? nullptr : context.clients.find(id);
  vm.return_float(!client ? 3.0f : client->active() ? 1.0f : 0.0f);
}

// isbackbuffered(player): whether what it was told has yet to reach it.
void isbackbuffered(Vm& vm, GameContext& context) {
  ServerClient* client = client_parm(vm, context, "isbackbuffered");
  vm.return_float(client && client->active() && client->spawned() && !client->connection->can_send() ? 1.0f : 0.0f);
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
    return vm.warn(fmt::format("lightstyle {}, of 0 to {}", style, net::kMaxLightStyles - 1));
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
  add_write(table, context, 280, "WriteFloat", [](MessageWriter& to, Vm& vm) { to.f32(vm.parm_float(1)); });
  // Without the zero at the end.
  add_write(table, context, 456, "WriteUnterminatedString", [](MessageWriter& to, Vm& vm) {
    for (const char c : vm.parm_string(1)) to.u8(static_cast<unsigned char>(c));
  });
  table.add_extension("DP_SV_WRITEUNTERMINATEDSTRING");
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
  // Who may see the place: here, everybody.
  set(82, "multicast",
      [](Vm& vm, GameContext& in) { in.clients.multicast(vm.parm_int(1), vm.get(globals::msg_entity)); });
  table.add_extension("FTE_QC_MULTICAST");
  set(234, "isbackbuffered", isbackbuffered);
  set(453, "dropclient", dropclient);
  table.add_extension("DP_SV_DROPCLIENT");
  set(455, "clienttype", clienttype);
  set(483, "pointsound", pointsound);
  table.add_extension("DP_SV_POINTSOUND");
  table.add_extension("DP_SV_PRINT");
  add_writes(table, context);
}

}  // namespace fb::sv
