// What falls, bounces and flies, and monsters between their steps.
#include "server/simulation/physics_moves.h"
#include "server/simulation/quakec.h"

namespace fb::sv {
namespace {

constexpr float kBounce = 1.5f;
constexpr float kBounceStop = 60.0f;  // units a second upwards: bounces of less come to rest

}  // namespace

// SV_Physics_Toss: toss, gib, bounce, fly and flymissile. Lies still on the ground, and looks for water only where
// something stopped it.
void physics_toss(Level& level, EdictId id) {
  if (!run_think(level, id)) return;
  Edict edict = level.edict(id);
  if (edict.has_flag(fields::flags, kFlagOnGround)) return;
  check_velocity(level, edict);
  const int movetype = enum_of(edict, fields::movetype);
  if (movetype != kMoveFly && movetype != kMoveFlyMissile) add_gravity(level, edict);

  const float seconds = frame_seconds(level);
  edict.set(fields::angles, edict.get(fields::angles) + seconds * edict.get(fields::avelocity));
  const MoveTrace trace = push_entity(level, id, edict.get(fields::velocity) * seconds);
  if (trace.fraction == 1.0f || edict.is_free() || level.failed()) return;

  const bool bounces = enum_of(edict, fields::movetype) == kMoveBounce;
  const vec3 velocity = clip_velocity(edict.get(fields::velocity), trace.plane.normal, bounces ? kBounce : 1.0f);
  edict.set(fields::velocity, velocity);
  if (static_cast<double>(trace.plane.normal.z) > kFloorNormal && (velocity.z < kBounceStop || !bounces)) {
    edict.add_flag(fields::flags, kFlagOnGround);
    edict.set(fields::groundentity, trace.edict.value_or(EdictId::kWorld));
    edict.set(fields::velocity, vec3(0.0f));
    edict.set(fields::avelocity, vec3(0.0f));
  }
  check_water_transition(level, edict);
}

// SV_Physics_Step: monsters fall where nothing holds them; all else they do in QuakeC, by steps.
void physics_step(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  if (!edict.has_flag(fields::flags, kFlagOnGround | kFlagFly | kFlagSwim)) {
    const double speed_of_thud = static_cast<double>(level.cvars.gravity.value()) * -0.1;
    const bool thud = static_cast<double>(edict.get(fields::velocity).z) < speed_of_thud;
    add_gravity(level, edict);
    check_velocity(level, edict);
    fly_move(level, id, frame_seconds(level));
    link_edict(level, id, true);
    if (thud && edict.has_flag(fields::flags, kFlagOnGround)) {
      level.events.start_sound(id, 0, "demon/dland2.wav", 1.0f, 1.0f);
    }
  }
  if (run_think(level, id)) check_water_transition(level, edict);
}

}  // namespace fb::sv
