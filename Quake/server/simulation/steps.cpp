#include "server/simulation/steps.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "progs/angles.h"
#include "server/simulation/link.h"
#include "server/simulation/quakec.h"

namespace fb::sv {
namespace {

constexpr double kTwoPi = 3.14159265358979323846 * 2.0;
constexpr std::int32_t kFlagsThatHold = kFlagOnGround | kFlagFly | kFlagSwim;

// 15 bits, as C's rand of old; QuakeC's random() draws from the same numbers.
std::uint32_t rand15(Level& level) { return level.rng.next() >> 17u; }

vec3 step_along(float yaw, float distance) {
  const auto radians = static_cast<double>(static_cast<float>(yaw * kTwoPi / 360.0));
  return {static_cast<float>(std::cos(radians) * distance), static_cast<float>(std::sin(radians) * distance), 0.0f};
}

bool moved(Level& level, EdictId id, bool relink) {
  if (relink) link_edict(level, id, true);
  return true;
}

// Those that fly or swim go towards the height of their enemy, by 8 units a step, and level where that is barred.
bool fly_step(Level& level, Edict edict, const vec3& move, bool relink) {
  const EdictId enemy = edict.get(fields::enemy);
  const vec3 origin = edict.get(fields::origin);
  for (const bool changes_height : {true, false}) {
    vec3 to = origin + move;
    if (changes_height && enemy != EdictId::kWorld) {
      const float above = origin.z - level.edict(enemy).get(fields::origin).z;
      if (above > 40.0f) to.z -= 8.0f;
      if (above < 30.0f) to.z += 8.0f;
    }
    const MoveTrace trace = move_edict(level, edict.id(), to);
    if (trace.fraction == 1.0f) {
      const bool swims = edict.has_flag(fields::flags, kFlagSwim);
      if (swims && point_contents(level, trace.end_pos) == formats::kContentsEmpty) return false;  // out of the water
      edict.set(fields::origin, trace.end_pos);
      return moved(level, edict.id(), relink);
    }
    if (enemy == EdictId::kWorld) break;  // the second try would be the first again
  }
  return false;
}

// From a step above the place down to a step below it; under a low ceiling from the place itself. Nothing: there is no
// room.
std::optional<MoveTrace> find_floor(Level& level, Edict edict, const vec3& to) {
  world::Move down{to, edict.get(fields::mins), edict.get(fields::maxs), to};
  down.start.z += kStepSize;
  down.end.z = down.start.z - kStepSize * 2.0f;
  MoveTrace trace = sv_move(level, down, MoveKind::kNormal, edict.id());
  if (trace.all_solid) return std::nullopt;
  if (trace.start_solid) {
    down.start.z -= kStepSize;
    trace = sv_move(level, down, MoveKind::kNormal, edict.id());
    if (trace.all_solid || trace.start_solid) return std::nullopt;
  }
  return trace;
}

// A monster of which the ground has been taken may go where none of the others may, to get down.
bool walk_step(Level& level, Edict edict, const vec3& move, bool relink) {
  const vec3 origin = edict.get(fields::origin);
  const bool partial_ground = edict.has_flag(fields::flags, kFlagPartialGround);
  const auto floor = find_floor(level, edict, origin + move);
  if (!floor) return false;
  if (floor->fraction == 1.0f) {
    if (!partial_ground) return false;  // the edge of a drop
    edict.set(fields::origin, origin + move);
    moved(level, edict.id(), relink);
    edict.remove_flag(fields::flags, kFlagOnGround);
    return true;
  }
  edict.set(fields::origin, floor->end_pos);
  if (!check_bottom(level, edict.id())) {
    if (partial_ground) return moved(level, edict.id(), relink);
    edict.set(fields::origin, origin);
    return false;
  }
  edict.remove_flag(fields::flags, kFlagPartialGround);
  edict.set(fields::groundentity, floor->edict.value_or(EdictId::kWorld));
  return moved(level, edict.id(), relink);
}

// SV_CloseEnough: whether the boxes are within `distance` along each axis.
bool close_enough(const Edict& edict, const Edict& goal, float distance) {
  const vec3 mins = edict.get(fields::absmin), maxs = edict.get(fields::absmax);
  const vec3 goal_mins = goal.get(fields::absmin), goal_maxs = goal.get(fields::absmax);
  for (int axis = 0; axis < 3; ++axis) {
    if (goal_mins[axis] > maxs[axis] + distance) return false;
    if (goal_maxs[axis] < mins[axis] - distance) return false;
  }
  return true;
}

constexpr float kNoDirection = -1.0f;

// Yaws along x and y towards something `x` and `y` away; none for less than ten units.
std::array<float, 2> directions_to(float x, float y) {
  return {x > 10.0f ? 0.0f : (x < -10.0f ? 180.0f : kNoDirection),
          y < -10.0f ? 270.0f : (y > 10.0f ? 90.0f : kNoDirection)};
}

}  // namespace

void change_yaw(Edict edict) {
  const float ideal = edict.get(fields::ideal_yaw), speed = edict.get(fields::yaw_speed);
  edict.set(fields::angles, progs::turned_towards(edict.get(fields::angles), 1, ideal, speed));
}

bool check_bottom(Level& level, EdictId id) {
  const Edict edict = level.edict(id);
  const vec3 mins = edict.get(fields::origin) + edict.get(fields::mins);
  const vec3 maxs = edict.get(fields::origin) + edict.get(fields::maxs);
  const std::array<vec3, 4> corners = {vec3(mins.x, mins.y, mins.z), vec3(mins.x, maxs.y, mins.z),
                                       vec3(maxs.x, mins.y, mins.z), vec3(maxs.x, maxs.y, mins.z)};
  // Mostly all corners are on the world.
  bool all_solid = true;
  for (const vec3& corner : corners) {
    const vec3 below(corner.x, corner.y, mins.z - 1.0f);
    if (point_contents(level, below) != formats::kContentsSolid) all_solid = false;
  }
  if (all_solid) return true;

  const auto ground_below = [&](const vec3& from) {
    const world::Move down{from, vec3(0.0f), vec3(0.0f), from - vec3(0.0f, 0.0f, 2.0f * kStepSize)};
    return sv_move(level, down, MoveKind::kNoMonsters, id);
  };
  const auto middle_of = [](float a, float b) { return static_cast<float>((a + b) * 0.5); };
  const MoveTrace middle = ground_below(vec3(middle_of(mins.x, maxs.x), middle_of(mins.y, maxs.y), mins.z));
  if (middle.fraction == 1.0f) return false;
  for (const vec3& corner : corners) {
    const MoveTrace ground = ground_below(corner);
    if (ground.fraction == 1.0f || middle.end_pos.z - ground.end_pos.z > kStepSize) return false;
  }
  return true;
}

bool move_step(Level& level, EdictId id, const vec3& move, bool relink) {
  Edict edict = level.edict(id);
  const bool flies = edict.has_flag(fields::flags, kFlagSwim | kFlagFly);
  return flies ? fly_step(level, edict, move, relink) : walk_step(level, edict, move, relink);
}

bool step_direction(Level& level, EdictId id, float yaw, float distance) {
  Edict edict = level.edict(id);
  edict.set(fields::ideal_yaw, yaw);
  change_yaw(edict);
  const vec3 origin = edict.get(fields::origin);
  const bool free = move_step(level, id, step_along(yaw, distance), false);
  if (free) {
    const float missing = edict.get(fields::angles).y - edict.get(fields::ideal_yaw);
    // A negative difference is never too much: so Quake has it.
    if (missing > 45.0f && missing < 315.0f) edict.set(fields::origin, origin);
  }
  link_edict(level, id, true);
  return free;
}

// Tries, in this order: the diagonal towards the goal, its two directions (the longer way first, or by chance), the way
// it went before, all around (from either end, by chance), back.
void new_chase_dir(Level& level, EdictId id, EdictId goal, float distance) {
  Edict edict = level.edict(id);
  const auto old_way = progs::angle_mod(static_cast<float>(progs::to_int(edict.get(fields::ideal_yaw) / 45.0f) * 45));
  const float back = progs::angle_mod(old_way - 180.0f);
  const vec3 to = level.edict(goal).get(fields::origin), from = edict.get(fields::origin);
  const float x = to.x - from.x, y = to.y - from.y;
  const auto steps = [&](float yaw) { return yaw != back && step_direction(level, id, yaw, distance); };
  const auto steps_if_any = [&](float yaw) { return yaw != kNoDirection && steps(yaw); };

  auto [first, second] = directions_to(x, y);
  if (first != kNoDirection && second != kNoDirection) {
    // South-west is 215 degrees, not 225: Quake's slip, which all monsters walk by.
    const float diagonal = first == 0.0f ? (second == 90.0f ? 45.0f : 315.0f) : (second == 90.0f ? 135.0f : 215.0f);
    if (steps(diagonal)) return;
  }
  const bool by_chance = (rand15(level) & 1u) != 0;
  const auto whole = [](float value) { return std::abs(static_cast<std::int64_t>(progs::to_int(value))); };
  if (by_chance || whole(y) > whole(x)) std::swap(first, second);
  if (steps_if_any(first) || steps_if_any(second)) return;
  if (old_way != kNoDirection && step_direction(level, id, old_way, distance)) return;

  const bool upwards = (rand15(level) & 1u) != 0;
  for (int i = 0; i < 8; ++i) {
    if (steps(static_cast<float>((upwards ? i : 7 - i) * 45))) return;
  }
  if (back != kNoDirection && step_direction(level, id, back, distance)) return;
  edict.set(fields::ideal_yaw, old_way);
  // Where the ground has gone, it may have no place to stand at all: may fall from now on (SV_FixCheckBottom).
  if (!check_bottom(level, id)) edict.add_flag(fields::flags, kFlagPartialGround);
}

void move_to_goal(Level& level, EdictId id, float distance) {
  const Edict edict = level.edict(id);
  if (!edict.has_flag(fields::flags, kFlagsThatHold)) return;
  const EdictId goal = edict.get(fields::goalentity);
  if (edict.get(fields::enemy) != EdictId::kWorld && close_enough(edict, level.edict(goal), distance)) return;
  // Sometimes another way, though this one is free.
  if ((rand15(level) & 3u) == 1u || !step_direction(level, id, edict.get(fields::ideal_yaw), distance)) {
    new_chase_dir(level, id, goal, distance);
  }
}

bool walkmove(Level& level, EdictId id, float yaw, float distance) {
  if (!level.edict(id).has_flag(fields::flags, kFlagsThatHold)) return false;
  const KeepSelfAndOther keep(*level.vm);
  return move_step(level, id, step_along(yaw, distance), true);
}

bool drop_to_floor(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  const vec3 down(0.0f, 0.0f, -256.0f);
  const MoveTrace trace = move_edict(level, id, edict.get(fields::origin) + down);
  if (trace.fraction == 1.0f || trace.all_solid) return false;
  edict.set(fields::origin, trace.end_pos);
  link_edict(level, id);
  edict.add_flag(fields::flags, kFlagOnGround);
  edict.set(fields::groundentity, trace.edict.value_or(EdictId::kWorld));
  return true;
}

}  // namespace fb::sv
