#include "server/simulation/physics.h"

#include "server/simulation/physics_moves.h"
#include "server/simulation/quakec.h"

namespace fb::sv {
namespace {

// SV_Physics_Noclip.
void physics_no_clip(Level& level, EdictId id) {
  if (!run_think(level, id)) return;
  Edict edict = level.edict(id);
  const float seconds = frame_seconds(level);
  edict.set(fields::angles, edict.get(fields::angles) + seconds * edict.get(fields::avelocity));
  edict.set(fields::origin, edict.get(fields::origin) + seconds * edict.get(fields::velocity));
  link_edict(level, id);
}

void physics_edict(Level& level, EdictId id) {
  switch (enum_of(level.edict(id), fields::movetype)) {
    case kMovePush:
      return physics_pusher(level, id);
    case kMoveNone:
      run_think(level, id);
      return;
    case kMoveNoClip:
      return physics_no_clip(level, id);
    case kMoveStep:
      return physics_step(level, id);
    case kMoveToss:
    case kMoveGib:
    case kMoveBounce:
    case kMoveFly:
    case kMoveFlyMissile:
      return physics_toss(level, id);
    default:
      return fail_movetype(level, id);
  }
}

}  // namespace

void physics(Level& level, const std::function<bool(EdictId)>& is_active_client) {
  progs::Vm& vm = *level.vm;
  if (!level.run(vm.get(globals::StartFrame), EdictId::kWorld)) return;

  // What is spawned in this frame, behind all that there is, moves from the next one on (QuakeSpasm; Quake moved it at
  // once). What takes a freed edict's place in the list still has its turn.
  const bool frozen = level.cvars.freeze_nonclients.on();
  const std::uint32_t count = frozen ? static_cast<std::uint32_t>(level.max_clients) + 1 : level.edicts().count();
  for (EdictId id = EdictId::kWorld; index(id) < count && !level.failed(); id = next(id)) {
    if (level.edict(id).is_free()) continue;
    if (vm.get(globals::force_retouch) != 0.0f) link_edict(level, id, true);
    if (level.is_client(id)) {
      if (is_active_client(id)) physics_client(level, id);
    } else {
      physics_edict(level, id);
    }
  }

  if (const float retouch = vm.get(globals::force_retouch); retouch != 0.0f) {
    vm.set(globals::force_retouch, retouch - 1.0f);
  }
  if (!frozen) level.time += level.frame_time;
}

}  // namespace fb::sv
