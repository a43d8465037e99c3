// How players move: sliding, stairs, and getting out of where they are stuck.
#include <array>
#include <cmath>

#include "base/log.h"
#include "server/simulation/float_vectors.h"
#include "server/simulation/physics_moves.h"
#include "server/simulation/quakec.h"
#include "server/simulation/skin_contents.h"
#include "server/simulation/steps.h"

namespace fb::sv {
namespace {

// SV_CheckStuck: notes where a player last was free; one that is stuck goes back there, or to the nearest free place
// up to 17 units above.
void check_stuck(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  const vec3 origin = edict.get(fields::origin);
  if (!in_solid(level, id)) {
    edict.set(fields::oldorigin, origin);
    return;
  }
  const auto try_at = [&](const vec3& place) {
    edict.set(fields::origin, place);
    if (in_solid(level, id)) return false;
    log_debug("unstuck");
    link_edict(level, id, true);
    return true;
  };
  if (try_at(edict.get(fields::oldorigin))) return;
  for (int z = 0; z < 18; ++z)
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        if (try_at(origin + vec3(x, y, z))) return;
  edict.set(fields::origin, origin);
  log_debug("player is stuck");
}

// SV_CheckWater: 0 dry, 1 feet, 2 waist, 3 eyes. True from the waist on. Sky counts as a liquid: it is below water in
// the order of contents.
bool check_water(Level& level, Edict edict) {
  const vec3 origin = edict.get(fields::origin);
  const float bottom = edict.get(fields::mins).z, top = edict.get(fields::maxs).z;
  const std::array<float, 3> heights = {origin.z + bottom + 1.0f, static_cast<float>(origin.z + (bottom + top) * 0.5),
                                        origin.z + edict.get(fields::view_ofs).z};
  int level_of_water = 0;
  edict.set(fields::watertype, static_cast<float>(formats::kContentsEmpty));
  for (const float height : heights) {
    const std::int32_t contents = point_contents(level, vec3(origin.x, origin.y, height));
    if (contents > formats::kContentsWater) break;
    if (level_of_water++ == 0) edict.set(fields::watertype, static_cast<float>(contents));
  }
  edict.set(fields::waterlevel, static_cast<float>(level_of_water));
  return level_of_water > 1;
}

// SV_WallFriction: who looks at the wall that it runs along is slower.
void wall_friction(Edict edict, const MoveTrace& wall) {
  const vec3 normal = wall.plane.normal;
  const float facing = dot(normal, angle_vectors(edict.get(fields::v_angle)).forward);
  const auto loss = static_cast<float>(facing + 0.5);
  if (loss >= 0.0f) return;
  vec3 velocity = edict.get(fields::velocity);
  const vec3 side = velocity - normal * dot(normal, velocity);
  velocity.x = side.x * (1.0f + loss);
  velocity.y = side.y * (1.0f + loss);
  edict.set(fields::velocity, velocity);
}

// The upward part of the velocity is left out where a move is tried on another height.
void set_level_velocity(Edict edict, const vec3& velocity) {
  edict.set(fields::velocity, vec3(velocity.x, velocity.y, 0.0f));
}

bool moved_more_than(const vec3& from, const vec3& to, double distance) {
  return std::fabs(static_cast<double>(from.y - to.y)) > distance ||
         std::fabs(static_cast<double>(from.x - to.x)) > distance;
}

// SV_TryUnstick: a player who came to a dead stop, perhaps by rounding where two planes meet, is moved two units to
// each side in turn, until a tenth of a second's way is free from there.
int try_unstick(Level& level, EdictId id, const vec3& velocity) {
  constexpr std::array<std::array<float, 2>, 8> kPushes = {
      {{2, 0}, {0, 2}, {-2, 0}, {0, -2}, {2, 2}, {-2, 2}, {2, -2}, {-2, -2}}};
  Edict edict = level.edict(id);
  const vec3 origin = edict.get(fields::origin);
  for (const auto& [x, y] : kPushes) {
    push_entity(level, id, vec3(x, y, 0.0f));
    set_level_velocity(edict, velocity);
    const int blocked = fly_move(level, id, 0.1f);
    if (moved_more_than(origin, edict.get(fields::origin), 4.0)) return blocked;
    edict.set(fields::origin, origin);
  }
  edict.set(fields::velocity, vec3(0.0f));
  return kBlockedFloor | kBlockedStep | kBlockedDead;
}

// Up a step, forward and down again, from `origin`. False: there was no floor.
bool climb_step(Level& level, EdictId id, const vec3& origin, const vec3& velocity, MoveTrace& wall) {
  Edict edict = level.edict(id);
  edict.set(fields::origin, origin);
  push_entity(level, id, vec3(0.0f, 0.0f, kStepSize));
  set_level_velocity(edict, velocity);
  int blocked = fly_move(level, id, frame_seconds(level), &wall);
  // Less than a trace's epsilon is no way at all.
  const auto no_way = [&] {
    const vec3 now = edict.get(fields::origin);
    return std::fabs(static_cast<double>(origin.y - now.y)) < 0.03125 &&
           std::fabs(static_cast<double>(origin.x - now.x)) < 0.03125;
  };
  if (blocked != 0 && no_way()) blocked = try_unstick(level, id, velocity);
  if ((blocked & kBlockedStep) != 0) wall_friction(edict, wall);

  const float down = static_cast<float>(-static_cast<double>(kStepSize) + velocity.z * level.frame_time);
  const MoveTrace floor = push_entity(level, id, vec3(0.0f, 0.0f, down));
  if (!(static_cast<double>(floor.plane.normal.z) > kFloorNormal)) return false;
  // Asks the player, who never is SOLID_BSP, and not the floor: so nobody stands on a step until the next frame.
  if (edict.get(fields::solid) == kSolidBsp) {
    edict.add_flag(fields::flags, kFlagOnGround);
    edict.set(fields::groundentity, floor.edict.value_or(EdictId::kWorld));
  }
  return true;
}

// SV_WalkMove: slides, and where that ended at a wall tries it a step higher.
void walk_move(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  const bool stood = edict.has_flag(fields::flags, kFlagOnGround);
  edict.remove_flag(fields::flags, kFlagOnGround);
  const vec3 origin = edict.get(fields::origin), velocity = edict.get(fields::velocity);
  MoveTrace wall;
  const int blocked = fly_move(level, id, frame_seconds(level), &wall);
  if ((blocked & kBlockedStep) == 0 || level.failed()) return;
  if (!stood && edict.get(fields::waterlevel) == 0.0f) return;  // no stairs while jumping
  if (enum_of(edict, fields::movetype) != kMoveWalk) return;    // a trigger has killed it
  if (level.cvars.no_step.on() || edict.has_flag(fields::flags, kFlagWaterJump)) return;

  const vec3 slid_origin = edict.get(fields::origin), slid_velocity = edict.get(fields::velocity);
  if (climb_step(level, id, origin, velocity, wall)) return;
  // No good ground up there: on slopes too steep one would hop up.
  edict.set(fields::origin, slid_origin);
  edict.set(fields::velocity, slid_velocity);
}

// False: it does not end here as others do (it is gone, or QuakeC failed).
bool move_client(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  switch (enum_of(edict, fields::movetype)) {
    case kMoveNone:
      return run_think(level, id);
    case kMoveWalk:
      if (!run_think(level, id)) return false;
      if (!check_water(level, edict) && !edict.has_flag(fields::flags, kFlagWaterJump) && !on_ladder(level, id))
        add_gravity(level, edict);
      check_stuck(level, id);
      walk_move(level, id);
      return true;
    case kMoveToss:
    case kMoveBounce:
    case kMoveGib:
      physics_toss(level, id);
      return true;
    case kMoveFly:
      if (!run_think(level, id)) return false;
      fly_move(level, id, frame_seconds(level));
      return true;
    case kMoveNoClip:
      if (!run_think(level, id)) return false;
      edict.set(fields::origin, edict.get(fields::origin) + frame_seconds(level) * edict.get(fields::velocity));
      return true;
    default:
      fail_movetype(level, id);
      return false;
  }
}

}  // namespace

// SV_Physics_Client.
void physics_client(Level& level, EdictId id) {
  if (!level.run(level.vm->get(globals::PlayerPreThink), id)) return;
  check_velocity(level, level.edict(id));
  if (!move_client(level, id)) return;
  link_edict(level, id, true);
  level.run(level.vm->get(globals::PlayerPostThink), id);
}

}  // namespace fb::sv
