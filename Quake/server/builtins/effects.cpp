// DarkPlaces' functions for temporary entities: those that Quake's own protocol has. The others are to be seen only,
// and nothing that this engine's clients know stands for them: no extension claims them, and calling them does nothing.
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

struct Unseen {
  std::uint32_t number;
  const char* name;
};
// And what needs a network protocol of other engines, as values of a mod's own in the status bar do.
constexpr Unseen kUnseen[] = {
    {232, "clientstat"},      {233, "globalstat"},      {335, "particleeffectnum"}, {336, "trailparticles"},
    {337, "pointparticles"},  {405, "te_blood"},        {406, "te_bloodshower"},    {407, "te_explosionrgb"},
    {408, "te_particlecube"}, {409, "te_particlerain"}, {410, "te_particlesnow"},   {411, "te_spark"},
    {412, "te_gunshotquad"},  {413, "te_spikequad"},    {414, "te_superspikequad"}, {415, "te_explosionquad"},
    {416, "te_smallflash"},   {417, "te_customflash"},
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
  add_beam(table, context, 428, "te_lightning1", TempEntityType::kLightning1);
  add_beam(table, context, 429, "te_lightning2", TempEntityType::kLightning2);
  add_beam(table, context, 430, "te_lightning3", TempEntityType::kLightning3);
  add_beam(table, context, 431, "te_beam", TempEntityType::kBeam);
  table.add_extension("DP_TE_STANDARDEFFECTBUILTINS");

  for (const Unseen& effect : kUnseen) table.set_idle(effect.number, effect.name);
}

}  // namespace fb::sv
