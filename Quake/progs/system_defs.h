// What the engine and every mod share: Quake's own globals and fields, which stand at fixed places (id's progdefs.h,
// whose checksum is progs.dat's CRC 5927). One row each: type, name, offset in words.
//
//   vm.get(globals::time), vm.set(globals::self, id), edict.get(fields::origin), edict.set(fields::health, 100.0f)
#pragma once

#include <span>

#include "progs/value.h"

namespace fb::progs {

// clang-format off
#define FB_SYSTEM_GLOBALS(X) \
  X(EdictId, self, 28) \
  X(EdictId, other, 29) \
  X(EdictId, world, 30) \
  X(float, time, 31) \
  X(float, frametime, 32) \
  X(float, force_retouch, 33) \
  X(StringId, mapname, 34) \
  X(float, deathmatch, 35) \
  X(float, coop, 36) \
  X(float, teamplay, 37) \
  X(float, serverflags, 38) \
  X(float, total_secrets, 39) \
  X(float, total_monsters, 40) \
  X(float, found_secrets, 41) \
  X(float, killed_monsters, 42) \
  X(float, parm1, 43) \
  X(float, parm2, 44) \
  X(float, parm3, 45) \
  X(float, parm4, 46) \
  X(float, parm5, 47) \
  X(float, parm6, 48) \
  X(float, parm7, 49) \
  X(float, parm8, 50) \
  X(float, parm9, 51) \
  X(float, parm10, 52) \
  X(float, parm11, 53) \
  X(float, parm12, 54) \
  X(float, parm13, 55) \
  X(float, parm14, 56) \
  X(float, parm15, 57) \
  X(float, parm16, 58) \
  X(vec3, v_forward, 59) \
  X(vec3, v_up, 62) \
  X(vec3, v_right, 65) \
  X(float, trace_allsolid, 68) \
  X(float, trace_startsolid, 69) \
  X(float, trace_fraction, 70) \
  X(vec3, trace_endpos, 71) \
  X(vec3, trace_plane_normal, 74) \
  X(float, trace_plane_dist, 77) \
  X(EdictId, trace_ent, 78) \
  X(float, trace_inopen, 79) \
  X(float, trace_inwater, 80) \
  X(EdictId, msg_entity, 81) \
  X(FunctionId, main, 82) \
  X(FunctionId, StartFrame, 83) \
  X(FunctionId, PlayerPreThink, 84) \
  X(FunctionId, PlayerPostThink, 85) \
  X(FunctionId, ClientKill, 86) \
  X(FunctionId, ClientConnect, 87) \
  X(FunctionId, PutClientInServer, 88) \
  X(FunctionId, ClientDisconnect, 89) \
  X(FunctionId, SetNewParms, 90) \
  X(FunctionId, SetChangeParms, 91)

#define FB_SYSTEM_FIELDS(X) \
  X(float, modelindex, 0) \
  X(vec3, absmin, 1) \
  X(vec3, absmax, 4) \
  X(float, ltime, 7) \
  X(float, movetype, 8) \
  X(float, solid, 9) \
  X(vec3, origin, 10) \
  X(vec3, oldorigin, 13) \
  X(vec3, velocity, 16) \
  X(vec3, angles, 19) \
  X(vec3, avelocity, 22) \
  X(vec3, punchangle, 25) \
  X(StringId, classname, 28) \
  X(StringId, model, 29) \
  X(float, frame, 30) \
  X(float, skin, 31) \
  X(float, effects, 32) \
  X(vec3, mins, 33) \
  X(vec3, maxs, 36) \
  X(vec3, size, 39) \
  X(FunctionId, touch, 42) \
  X(FunctionId, use, 43) \
  X(FunctionId, think, 44) \
  X(FunctionId, blocked, 45) \
  X(float, nextthink, 46) \
  X(EdictId, groundentity, 47) \
  X(float, health, 48) \
  X(float, frags, 49) \
  X(float, weapon, 50) \
  X(StringId, weaponmodel, 51) \
  X(float, weaponframe, 52) \
  X(float, currentammo, 53) \
  X(float, ammo_shells, 54) \
  X(float, ammo_nails, 55) \
  X(float, ammo_rockets, 56) \
  X(float, ammo_cells, 57) \
  X(float, items, 58) \
  X(float, takedamage, 59) \
  X(EdictId, chain, 60) \
  X(float, deadflag, 61) \
  X(vec3, view_ofs, 62) \
  X(float, button0, 65) \
  X(float, button1, 66) \
  X(float, button2, 67) \
  X(float, impulse, 68) \
  X(float, fixangle, 69) \
  X(vec3, v_angle, 70) \
  X(float, idealpitch, 73) \
  X(StringId, netname, 74) \
  X(EdictId, enemy, 75) \
  X(float, flags, 76) \
  X(float, colormap, 77) \
  X(float, team, 78) \
  X(float, max_health, 79) \
  X(float, teleport_time, 80) \
  X(float, armortype, 81) \
  X(float, armorvalue, 82) \
  X(float, waterlevel, 83) \
  X(float, watertype, 84) \
  X(float, ideal_yaw, 85) \
  X(float, yaw_speed, 86) \
  X(EdictId, aiment, 87) \
  X(EdictId, goalentity, 88) \
  X(float, spawnflags, 89) \
  X(StringId, target, 90) \
  X(StringId, targetname, 91) \
  X(float, dmg_take, 92) \
  X(float, dmg_save, 93) \
  X(EdictId, dmg_inflictor, 94) \
  X(EdictId, owner, 95) \
  X(vec3, movedir, 96) \
  X(StringId, message, 99) \
  X(float, sounds, 100) \
  X(StringId, noise, 101) \
  X(StringId, noise1, 102) \
  X(StringId, noise2, 103) \
  X(StringId, noise3, 104)
// clang-format on

constexpr std::uint32_t kOfsNull = 0, kOfsReturn = 1, kOfsParm0 = 4;  // parm i stands at kOfsParm0 + 3 * i
constexpr std::uint32_t kMaxParms = 8;
constexpr std::uint32_t kReservedGlobals = 28;                     // the above
constexpr std::uint32_t kSystemGlobals = 92, kSystemFields = 105;  // words
constexpr std::uint16_t kProgsCrc = 5927;

namespace globals {
#define FB_DECLARE(type, name, offset) inline constexpr Global<type> name{offset};
FB_SYSTEM_GLOBALS(FB_DECLARE)
#undef FB_DECLARE
// parm 0 is parm1.
constexpr Global<float> spawn_parm(std::uint32_t i) { return {parm1.offset + i}; }
constexpr std::uint32_t kSpawnParms = 16;
}  // namespace globals

namespace fields {
#define FB_DECLARE(type, name, offset) inline constexpr Field<type> name{offset};
FB_SYSTEM_FIELDS(FB_DECLARE)
#undef FB_DECLARE
}  // namespace fields

struct SystemDefinition {
  Type type;
  const char* name;
  std::uint32_t offset;
};
std::span<const SystemDefinition> system_globals();
std::span<const SystemDefinition> system_fields();

}  // namespace fb::progs
