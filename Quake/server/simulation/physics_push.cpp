// Doors, lifts and trains: what moves whatever is in its way, or is stopped by it.
#include <utility>
#include <vector>

#include "server/simulation/physics_moves.h"
#include "server/simulation/quakec.h"

namespace fb::sv {
namespace {

// Ways off what something is a hair within: up, where it stands on a lift, first.
constexpr vec3 kWaysOff[] = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}};

bool apart(const Bounds& a, const Bounds& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] >= b.max[axis] || a.max[axis] <= b.min[axis]) return true;
  return false;
}

// SV_PushMove for one pusher and frame.
class PushMove {
 public:
  PushMove(Level& level, EdictId pusher, float seconds)
      : level_(level), id_(pusher), pusher_(level.edict(pusher)), seconds_(seconds) {}

  // Moves, or stays where it was if something is in the way.
  void run() {
    add_to_clock(seconds_);
    if (level_.asked.rotating_pushers) turn_ = pusher_.get(fields::avelocity) * seconds_;
    if (pusher_.get(fields::velocity) == vec3(0.0f) && !turns()) return;
    move_ = pusher_.get(fields::velocity) * seconds_;
    final_.min = pusher_.get(fields::absmin) + move_;
    final_.max = pusher_.get(fields::absmax) + move_;
    from_ = Place(pusher_);
    pusher_.set(fields::origin, from_.origin + move_);
    if (turns()) pusher_.set(fields::angles, from_.angles + turn_);
    link_edict(level_, id_);
    if (turns()) {
      final_.min = pusher_.get(fields::absmin);
      final_.max = pusher_.get(fields::absmax);
    }

    for (EdictId id{1}; level_.edicts().valid(id) && !level_.failed(); id = next(id)) {
      Edict edict = level_.edict(id);
      if (!is_in_the_way(edict)) continue;
      if (!carry(edict)) return block(edict);
    }
  }

 private:
  struct Place {
    Place() = default;
    explicit Place(const Edict& edict) : origin(edict.get(fields::origin)), angles(edict.get(fields::angles)) {}
    void put_back(Edict edict) const {
      edict.set(fields::origin, origin);
      edict.set(fields::angles, angles);
    }
    vec3 origin{0.0f}, angles{0.0f};
  };

  bool turns() const { return turn_ != vec3(0.0f); }
  // How far something at `origin` goes along.
  vec3 way_of(const vec3& origin) const {
    if (!turns()) return move_;
    const vec3 in_pusher = transform_point(inverse_affine(entity_transform(from_.origin, from_.angles)), origin);
    return transform_point(entity_transform(from_.origin + move_, from_.angles + turn_), in_pusher) - origin;
  }

  void add_to_clock(float seconds) { pusher_.set(fields::ltime, pusher_.get(fields::ltime) + seconds); }

  bool is_in_the_way(const Edict& edict) {
    if (edict.is_free()) return false;
    const int movetype = enum_of(edict, fields::movetype);
    if (movetype == kMovePush || movetype == kMoveNone || movetype == kMoveNoClip) return false;
    // Who stands on it comes along in any case.
    if (edict.has_flag(fields::flags, kFlagOnGround) && edict.get(fields::groundentity) == id_) return true;
    Bounds box;
    box.min = edict.get(fields::absmin);
    box.max = edict.get(fields::absmax);
    return !apart(box, final_) && in_solid(level_, edict.id());
  }

  // Moves an edict along. False: it cannot, and is no such thing as is just crushed.
  bool carry(Edict edict) {
    if (enum_of(edict, fields::movetype) != kMoveWalk) edict.remove_flag(fields::flags, kFlagOnGround);
    moved_.emplace_back(edict, Place(edict));
    // QuakeC that is touched on the way sees a pusher that is not solid, and one that was never SOLID_BSP becomes so.
    pusher_.set(fields::solid, static_cast<float>(kSolidNot));
    push_entity(level_, edict.id(), way_of(edict.get(fields::origin)));
    pusher_.set(fields::solid, static_cast<float>(kSolidBsp));
    turn_along(edict);
    if (level_.failed() || !in_solid(level_, edict.id())) return true;

    const vec3 mins = edict.get(fields::mins);
    if (mins.x == edict.get(fields::maxs).x) return true;  // a point
    if (spared(edict.id()) && free_of_rounding(edict)) return true;
    const auto solid = edict.get(fields::solid);
    if (solid != kSolidNot && solid != kSolidTrigger) return false;
    const vec3 flat(0.0f, 0.0f, mins.z);  // a corpse: from now on a point
    edict.set(fields::mins, flat);
    edict.set(fields::maxs, flat);
    return true;
  }

  bool spared(EdictId id) const {
    const float whom = level_.cvars.elevators.value();
    return whom >= 2.0f || (whom != 0.0f && level_.is_client(id));
  }

  // A pusher and what moves with it round their places apart. After some hundred frames the hair's breadth that was
  // between them may be used up, and they meet though nothing is in the way. Moves that breadth off if that frees it.
  bool free_of_rounding(Edict edict) {
    const vec3 origin = edict.get(fields::origin);
    for (const vec3& way : kWaysOff) {
      edict.set(fields::origin, origin + way * static_cast<float>(world::kDistEpsilon));
      if (in_solid(level_, edict.id())) continue;
      link_edict(level_, edict.id());
      return true;
    }
    edict.set(fields::origin, origin);
    return false;
  }

  // Players look where they want to.
  void turn_along(Edict edict) {
    if (!turns() || edict.is_free() || level_.is_client(edict.id())) return;
    vec3 angles = edict.get(fields::angles);
    angles.y += turn_.y;
    edict.set(fields::angles, angles);
  }

  // Undoes everything. The order of links is Quake's: what blocks first, then the pusher, the moved ones after QuakeC.
  void block(Edict edict) {
    moved_.back().second.put_back(edict);
    link_edict(level_, edict.id(), true);
    from_.put_back(pusher_);
    link_edict(level_, id_);
    add_to_clock(-seconds_);
    level_.run(pusher_.get(fields::blocked), id_, edict.id());
    for (auto& [moved, place] : moved_) {
      place.put_back(moved);
      link_edict(level_, moved.id());
    }
  }

  Level& level_;
  EdictId id_;
  Edict pusher_;
  float seconds_;
  vec3 move_{0.0f}, turn_{0.0f};  // units, degrees
  Place from_;
  Bounds final_;                                // where it goes
  std::vector<std::pair<Edict, Place>> moved_;  // and from where
};

}  // namespace

// SV_Physics_Pusher: its clock, ltime, stands still while something blocks it, and its thinks go by that clock: each
// movement ends exactly at nextthink.
void physics_pusher(Level& level, EdictId id) {
  Edict edict = level.edict(id);
  const float clock_before = edict.get(fields::ltime), think_time = edict.get(fields::nextthink);
  float seconds = frame_seconds(level);
  if (think_time < clock_before + level.frame_time) {
    seconds = think_time - clock_before;
    if (seconds < 0.0f) seconds = 0.0f;
  }
  if (seconds != 0.0f) PushMove(level, id, seconds).run();
  if (level.failed() || !(think_time > clock_before && think_time <= edict.get(fields::ltime))) return;
  edict.set(fields::nextthink, 0.0f);
  level.run(edict.get(fields::think), id);
}

}  // namespace fb::sv
