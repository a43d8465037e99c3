// DarkPlaces' functions for temporary entities: those that Quake's own protocol has, and of the others what its
// particles and explosions can show. No extension claims the latter: it would promise their messages, which end a game
// for Quake's clients.
#include <algorithm>

#include "server/builtins/game_builtins.h"

namespace fb::sv {
namespace {

using net::TempEntityType;
using progs::BuiltinTable;
using progs::Vm;

void send(Vm& vm, GameContext& context, const net::svc::TempEntity& effect) {
  if (vm.failed()) return;
  if (const auto writer = context.clients.destination(0, EdictId::kWorld))
    net::write_server_message(**writer, net::ServerMessage(effect));
}

// te_xxx(origin)
void add_at_point(BuiltinTable& table, GameContext& context, std::uint32_t number, std::string_view name,
                  TempEntityType type) {
  table.set(number, name, [&context, type](Vm& vm) {
    net::svc::TempEntity effect;
    effect.type = type;
    effect.origin = vm.parm_vector(0);
    send(vm, context, effect);
  });
}

// te_xxx(owner, from, to)
void add_beam(BuiltinTable& table, GameContext& context, std::uint32_t number, std::string_view name,
              TempEntityType type) {
  table.set(number, name, [&context, type](Vm& vm) {
    net::svc::TempEntity effect;
    effect.type = type;
    effect.entity = static_cast<int>(index(vm.parm_entity(0)));
    effect.origin = vm.parm_vector(1);
    effect.end = vm.parm_vector(2);
    send(vm, context, effect);
  });
}

// Of the palette: particles take one of eight colours from here on.
constexpr int kBlood = 73, kLightningBlood = 225, kSparks = 104, kFlames = 232;

void particles(GameContext& context, const vec3& origin, const vec3& direction, int color, float count) {
  const int most = 254;  // 255 is an explosion's
  context.clients.start_particle(origin, direction, color, std::clamp(progs::to_int(count), 0, most));
}

// All over a box: around eight points of it, an eighth each.
void particles_in_box(GameContext& context, const vec3& low, const vec3& high, const vec3& direction, int color,
                      float count) {
  for (int i = 0; i < 8; ++i) {
    const vec3 share(i & 1 ? 0.75f : 0.25f, i & 2 ? 0.75f : 0.25f, i & 4 ? 0.75f : 0.25f);
    particles(context, low + (high - low) * share, direction, color, count / 8.0f);
  }
}

void add_particles(BuiltinTable& table, GameContext& context) {
  const auto set = [&](std::uint32_t number, std::string_view name, void (*builtin)(Vm&, GameContext&)) {
    table.set(number, name, [&context, builtin](Vm& vm) { builtin(vm, context); });
  };
  set(219, "te_lightningblood",
      [](Vm& vm, GameContext& in) { particles(in, vm.parm_vector(0), vec3(0.0f), kLightningBlood, 50.0f); });
  set(239, "te_bloodqw",
      [](Vm& vm, GameContext& in) { particles(in, vm.parm_vector(0), vec3(0.0f), kBlood, vm.parm_float(1) * 20.0f); });
  set(405, "te_blood",
      [](Vm& vm, GameContext& in) { particles(in, vm.parm_vector(0), vm.parm_vector(1), kBlood, vm.parm_float(2)); });
  set(406, "te_bloodshower", [](Vm& vm, GameContext& in) {
    particles_in_box(in, vm.parm_vector(0), vm.parm_vector(1), vec3(0.0f), kBlood, vm.parm_float(3));
  });
  set(408, "te_particlecube", [](Vm& vm, GameContext& in) {
    particles_in_box(in, vm.parm_vector(0), vm.parm_vector(1), vm.parm_vector(2), vm.parm_int(4) & 0xff,
                     vm.parm_float(3));
  });
  set(411, "te_spark",
      [](Vm& vm, GameContext& in) { particles(in, vm.parm_vector(0), vm.parm_vector(1), kSparks, vm.parm_float(2)); });
  set(457, "te_flamejet",
      [](Vm& vm, GameContext& in) { particles(in, vm.parm_vector(0), vm.parm_vector(1), kFlames, vm.parm_float(2)); });
}

struct Unseen {
  std::uint32_t number;
  const char* name;
};
// Lights, sprites and weather; and what needs a network protocol of other engines, as values of a mod's own in the
// status bar do.
constexpr Unseen kUnseen[] = {
    {232, "clientstat"},     {233, "globalstat"},     {335, "particleeffectnum"}, {336, "trailparticles"},
    {337, "pointparticles"}, {404, "effect"},         {409, "te_particlerain"},   {410, "te_particlesnow"},
    {416, "te_smallflash"},  {417, "te_customflash"}, {433, "te_plasmaburn"},     {443, "setattachment"},
    {454, "spawnclient"},    {513, "uri_get"},
};

}  // namespace

void add_effect_builtins(BuiltinTable& table, GameContext& context) {
  add_at_point(table, context, 418, "te_gunshot", TempEntityType::kGunshot);
  add_at_point(table, context, 419, "te_spike", TempEntityType::kSpike);
  add_at_point(table, context, 420, "te_superspike", TempEntityType::kSuperSpike);
  add_at_point(table, context, 421, "te_explosion", TempEntityType::kExplosion);
  add_at_point(table, context, 422, "te_tarexplosion", TempEntityType::kTarExplosion);
  add_at_point(table, context, 423, "te_wizspike", TempEntityType::kWizSpike);
  add_at_point(table, context, 424, "te_knightspike", TempEntityType::kKnightSpike);
  add_at_point(table, context, 425, "te_lavasplash", TempEntityType::kLavaSplash);
  add_at_point(table, context, 426, "te_teleport", TempEntityType::kTeleport);
  table.set(427, "te_explosion2", [&context](Vm& vm) {
    net::svc::TempEntity effect;
    effect.type = TempEntityType::kExplosion2;
    effect.origin = vm.parm_vector(0);
    effect.color_start = vm.parm_int(1) & 0xff;
    effect.color_length = vm.parm_int(2) & 0xff;
    send(vm, context, effect);
  });
  // In the colour of an explosion, without the light of a quad.
  add_at_point(table, context, 407, "te_explosionrgb", TempEntityType::kExplosion);
  add_at_point(table, context, 412, "te_gunshotquad", TempEntityType::kGunshot);
  add_at_point(table, context, 413, "te_spikequad", TempEntityType::kSpike);
  add_at_point(table, context, 414, "te_superspikequad", TempEntityType::kSuperSpike);
  add_at_point(table, context, 415, "te_explosionquad", TempEntityType::kExplosion);
  add_particles(table, context);
  add_beam(table, context, 428, "te_lightning1", TempEntityType::kLightning1);
  add_beam(table, context, 429, "te_lightning2", TempEntityType::kLightning2);
  add_beam(table, context, 430, "te_lightning3", TempEntityType::kLightning3);
  add_beam(table, context, 431, "te_beam", TempEntityType::kBeam);
  table.add_extension("DP_TE_STANDARDEFFECTBUILTINS");

  for (const Unseen& effect : kUnseen) table.set_idle(effect.number, effect.name);
}

}  // namespace fb::sv
