#include "server/simulation/physics_moves.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/log.h"
#include "server/simulation/float_vectors.h"
#include "server/simulation/quakec.h"

namespace fb::sv {
namespace {

constexpr int kBumps = 4;
constexpr std::size_t kMostPlanes = 5;
constexpr double kStopEpsilon = 0.1;  // units a second: less is none

bool is_there(const Level& level, const Edict& edict) { return !edict.is_free() && !level.failed(); }

// Clients take thinks to be a tenth of a second apart; others they must be told of (protocols 666 and 999).
bool needs_interval(const Edict& edict, float think_time, float frame_before) {
  if (edict.is_free() || edict.get(fields::nextthink) == 0.0f) return false;
  if (enum_of(edict, fields::movetype) != kMoveStep && edict.get(fields::frame) == frame_before) return false;
  const double interval = static_cast<double>((edict.get(fields::nextthink) - think_time) * 255.0f);
  const int coded = progs::to_int(interval > 0.0 ? interval + 0.5 : interval - 0.5);
  return coded >= 0 && coded < 256 && coded != 25 && coded != 26;
}

// What became solid ground under the edict, and which kinds of plane stopped it.
int note_blocked(Level& level, Edict edict, const MoveTrace& trace, MoveTrace* step) {
  int blocked = 0;
  if (static_cast<double>(trace.plane.normal.z) > kFloorNormal) {
    blocked |= kBlockedFloor;
    if (level.edict(*trace.edict).get(fields::solid) == kSolidBsp) {
      edict.add_flag(fields::flags, kFlagOnGround);
      edict.set(fields::groundentity, *trace.edict);
    }
  }
  if (trace.plane.normal.z == 0.0f) {
    blocked |= kBlockedStep;
    if (step) *step = trace;
  }
  return blocked;
}

// A velocity along one of the planes that goes into none of the others.
std::optional<vec3> along_planes(const vec3& velocity, std::span<const vec3> planes) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const vec3 clipped = clip_velocity(velocity, planes[i], 1.0f);
    bool free = true;
    for (std::size_t j = 0; j < planes.size() && free; ++j) free = j == i || !(dot(clipped, planes[j]) < 0.0f);
    if (free) return clipped;
  }
  return std::nullopt;
}

}  // namespace

// The time is the think's own, which may lie within the frame; what is overdue is due now, as a trigger's local time
// may have set it.
bool run_think(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  float think_time = edict.get(fields::nextthink);
  if (think_time <= 0.0f || think_time > level.time + level.frame_time) return true;
  if (think_time < level.time) think_time = static_cast<float>(level.time);

  const float frame_before = edict.get(fields::frame);
  edict.set(fields::nextthink, 0.0f);
  level.run_at(edict.get(fields::think), id, EdictId::kWorld, static_cast<double>(think_time));
  level.extra(id).send_interval = needs_interval(edict, think_time, frame_before);
  return is_there(level, edict);
}

void impact(Level& level, EdictId one, EdictId other) {
  const KeepSelfAndOther keep(*level.vm);
  const auto touch = [&](EdictId self, EdictId what) {
    const Edict edict = level.edict(self);
    if (edict.get(fields::solid) != kSolidNot) level.run(edict.get(fields::touch), self, what);
  };
  touch(one, other);
  touch(other, one);
}

void check_velocity(Level& level, Edict edict) {
  vec3 velocity = edict.get(fields::velocity), origin = edict.get(fields::origin);
  const float limit = level.cvars.max_velocity.value();
  const auto mend = [&](float& value, const char* what) {
    if (std::isfinite(value)) return;
    log_warning("{} had a {} that is no number", describe(level, edict.id()), what);
    value = 0.0f;
  };
  for (int axis = 0; axis < 3; ++axis) {
    mend(velocity[axis], "velocity");
    mend(origin[axis], "origin");
    if (velocity[axis] > limit) {
      velocity[axis] = limit;
    } else if (velocity[axis] < -limit) {
      velocity[axis] = -limit;
    }
  }
  edict.set(fields::velocity, velocity);
  edict.set(fields::origin, origin);
}

void add_gravity(Level& level, Edict edict) {
  const float own = edict.get(level.optional.gravity);
  const float gravity = (own != 0.0f ? own : 1.0f) * level.cvars.gravity.value();
  vec3 velocity = edict.get(fields::velocity);
  velocity.z = static_cast<float>(velocity.z - gravity * level.frame_time);
  edict.set(fields::velocity, velocity);
}

vec3 clip_velocity(const vec3& in, const vec3& normal, float overbounce) {
  const float backoff = dot(in, normal) * overbounce;
  vec3 out;
  for (int axis = 0; axis < 3; ++axis) {
    out[axis] = in[axis] - normal[axis] * backoff;
    const double value = out[axis];
    if (value > -kStopEpsilon && value < kStopEpsilon) out[axis] = 0.0f;
  }
  return out;
}

int fly_move(Level& level, EdictId id, float seconds, MoveTrace* step) {
  Edict edict = level.edict(id);
  const auto stop = [&](int blocked) {
    edict.set(fields::velocity, vec3(0.0f));
    return blocked;
  };
  const vec3 first_velocity = edict.get(fields::velocity);
  vec3 slid_velocity = first_velocity;  // as it was when something was last got past
  std::array<vec3, kMostPlanes> planes;
  std::size_t plane_count = 0;
  int blocked = 0;
  for (int bump = 0; bump < kBumps; ++bump) {
    const vec3 velocity = edict.get(fields::velocity);
    if (velocity == vec3(0.0f)) break;
    const MoveTrace trace = move_edict(level, id, edict.get(fields::origin) + seconds * velocity);
    if (trace.all_solid) return stop(kBlockedFloor | kBlockedStep);
    if (trace.fraction > 0.0f) {
      edict.set(fields::origin, trace.end_pos);
      slid_velocity = velocity;
      plane_count = 0;
    }
    if (trace.fraction == 1.0f || !trace.edict) break;

    blocked |= note_blocked(level, edict, trace, step);
    impact(level, id, *trace.edict);
    if (!is_there(level, edict)) break;
    seconds -= seconds * trace.fraction;
    if (plane_count >= kMostPlanes) return stop(kBlockedFloor | kBlockedStep);
    planes[plane_count++] = trace.plane.normal;

    if (const auto along = along_planes(slid_velocity, std::span(planes).first(plane_count))) {
      edict.set(fields::velocity, *along);
    } else if (plane_count == 2) {  // along the crease between them
      const vec3 crease = cross(planes[0], planes[1]);
      edict.set(fields::velocity, crease * dot(crease, edict.get(fields::velocity)));
    } else {
      return stop(kBlockedFloor | kBlockedStep | kBlockedDead);
    }
    // Turned back: stops, lest it swings to and fro in a corner.
    if (dot(edict.get(fields::velocity), first_velocity) <= 0.0f) return stop(blocked);
  }
  return blocked;
}

MoveTrace push_entity(Level& level, EdictId id, const vec3& push) {
  Edict edict = level.edict(id);
  const auto solid = edict.get(fields::solid);
  MoveKind kind = MoveKind::kNormal;
  if (enum_of(edict, fields::movetype) == kMoveFlyMissile) {
    kind = MoveKind::kMissile;
  } else if (solid == kSolidTrigger || solid == kSolidNot) {
    kind = MoveKind::kNoMonsters;  // only what is of the map stops it
  }
  const MoveTrace trace = move_edict(level, id, edict.get(fields::origin) + push, kind);
  edict.set(fields::origin, trace.end_pos);
  link_edict(level, id, true);
  if (trace.edict) impact(level, id, *trace.edict);
  return trace;
}

// watertype 0: this is the first look, without a splash. Out of water, waterlevel is the contents: so Quake has it.
void check_water_transition(Level& level, Edict edict) {
  const std::int32_t contents = point_contents(level, edict.get(fields::origin));
  const float before = edict.get(fields::watertype);
  if (before == 0.0f) {
    edict.set(fields::watertype, static_cast<float>(contents));
    edict.set(fields::waterlevel, 1.0f);
    return;
  }
  constexpr auto kDry = static_cast<float>(formats::kContentsEmpty);
  const bool was_dry = before == kDry, is_wet = contents <= formats::kContentsWater;
  if (was_dry == is_wet) level.events.start_sound(edict.id(), 0, "misc/h2ohit1.wav", 1.0f, 1.0f);
  edict.set(fields::watertype, is_wet ? static_cast<float>(contents) : kDry);
  edict.set(fields::waterlevel, is_wet ? 1.0f : static_cast<float>(contents));
}

void fail_movetype(Level& level, EdictId id) {
  level.fail(fmt::format("{} has movetype {}, which it cannot have", describe(level, id),
                         level.edict(id).get(fields::movetype)));
}

}  // namespace fb::sv
