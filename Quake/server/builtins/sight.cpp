// How QuakeC finds what is around it: players in sight, things near, what a shot should be bent to.
#include <cmath>
#include <algorithm>

#include "server/builtins/game_builtins.h"
#include "server/simulation/link.h"

namespace fb::sv {
namespace {

using progs::BuiltinTable;
using progs::Vm;
namespace fields = progs::fields;
namespace globals = progs::globals;

vec3 eyes(const Edict& edict) { return edict.get(fields::origin) + edict.get(fields::view_ofs); }
vec3 middle(const Edict& edict) {
  return edict.get(fields::origin) + 0.5f * (edict.get(fields::mins) + edict.get(fields::maxs));
}

// The next player behind `checked`, round and round, who lives and may be noticed; `checked` again where there is no
// other.
EdictId next_client(Level& level, EdictId checked) {
  const auto last = static_cast<std::uint32_t>(level.max_clients);
  const std::uint32_t start = std::clamp(index(checked), 1u, last);
  for (std::uint32_t i = start % last + 1; i != start; i = i % last + 1) {
    const Edict edict = level.edict(EdictId{i});
    if (!edict.is_free() && edict.get(fields::health) > 0.0f && !edict.has_flag(fields::flags, kFlagNoTarget))
      return EdictId{i};
  }
  return EdictId{start};
}

// Players take turns, each a tenth of a second: the one whose turn it is, where self may be in its sight.
void checkclient(Vm& vm, GameContext& context) {
  Level& level = *context.level;
  if (level.time - level.last_check_time >= 0.1) {
    level.last_checked_client = next_client(level, level.last_checked_client);
    level.last_check_time = level.time;
    const vec3 eye = eyes(level.edict(level.last_checked_client));
    context.check_pvs = world::leaf_pvs(*level.bsp, world::pvs_leaf(*level.bsp, eye));
  }
  vm.return_edict(EdictId::kWorld);
  const Edict client = level.edict(level.last_checked_client);
  if (client.is_free() || client.get(fields::health) <= 0.0f) return;
  const std::uint32_t leaf = world::pvs_leaf(*level.bsp, eyes(vm.self()));
  if (leaf != 0 && context.check_pvs.contains(leaf)) vm.return_edict(client.id());
}

// findradius(origin, radius): all that are not SOLID_NOT, linked by .chain, the last one first.
void findradius(Vm& vm, GameContext&) {
  const vec3 origin = vm.parm_vector(0);
  const float radius = vm.parm_float(1);
  EdictId chain = EdictId::kWorld;
  for (EdictId id{1}; vm.edicts().valid(id); id = next(id)) {
    Edict edict = vm.edict(id);
    if (edict.is_free() || edict.get(fields::solid) == static_cast<float>(kSolidNot)) continue;
    if (length(origin - middle(edict)) > radius) continue;
    edict.set(fields::chain, chain);
    chain = id;
  }
  vm.return_edict(chain);
}

bool same_team(const Level& level, const Edict& a, const Edict& b) {
  return level.cvars.teamplay.on() && a.get(fields::team) > 0.0f && a.get(fields::team) == b.get(fields::team);
}

vec3 normalised(const vec3& v) {
  const float l = length(v);
  return l > 0.0f ? v / l : vec3(0.0f);
}

// What a shot from entity along v_forward would be bent to: itself where it hits something to aim at; else the thing in
// sight that is nearest to it by angle, if within sv_aim. The turn is up or down alone.
void aim(Vm& vm, GameContext& context) {
  Level& level = *context.level;
  const EdictId shooter_id = vm.parm_entity(0);
  if (vm.failed()) return;
  const Edict shooter = vm.edict(shooter_id);
  const vec3 forward = vm.get(globals::v_forward);
  const vec3 start = shooter.get(fields::origin) + vec3(0.0f, 0.0f, 20.0f);
  const auto hit_by_shot_to = [&](const vec3& end) {
    return sv_move(level, {start, vec3(0.0f), vec3(0.0f), end}, MoveKind::kNormal, shooter_id).edict;
  };
  vm.return_vector(forward);
  if (const auto hit = hit_by_shot_to(start + 2048.0f * forward)) {
    const Edict target = vm.edict(*hit);
    if (target.get(fields::takedamage) == static_cast<float>(kDamageAim) && !same_team(level, shooter, target)) return;
  }
  float best_cosine = level.cvars.aim.value();
  std::optional<EdictId> best;
  for (EdictId id{1}; vm.edicts().valid(id); id = next(id)) {
    const Edict target = vm.edict(id);
    if (target.get(fields::takedamage) != static_cast<float>(kDamageAim) || id == shooter_id) continue;
    if (same_team(level, shooter, target)) continue;
    const vec3 end = middle(target);
    const float cosine = dot(normalised(end - start), forward);
    if (cosine < best_cosine || hit_by_shot_to(end) != id) continue;
    best_cosine = cosine;
    best = id;
  }
  if (!best) return;
  const vec3 to_best = vm.edict(*best).get(fields::origin) - shooter.get(fields::origin);
  vec3 bent = forward * dot(to_best, forward);
  bent.z = to_best.z;
  vm.return_vector(normalised(bent));
}

}  // namespace

void add_sight_builtins(BuiltinTable& table, GameContext& context) {
  table.set(17, "checkclient", [&context](Vm& vm) { checkclient(vm, context); });
  table.set(22, "findradius", [&context](Vm& vm) { findradius(vm, context); });
  table.set(44, "aim", [&context](Vm& vm) { aim(vm, context); });
}

}  // namespace fb::sv
