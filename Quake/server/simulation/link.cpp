#include "server/simulation/link.h"

#include <fmt/format.h>

#include "server/simulation/quakec.h"
#include "server/simulation/skin_contents.h"

namespace fb::sv {
namespace {

int list_id(EdictId id) { return static_cast<int>(index(id)); }
EdictId edict_id(int list_id) { return EdictId{static_cast<std::uint32_t>(list_id)}; }

bool is_touched_by(const Edict& trigger, const Bounds& box) {
  return trigger.get(fields::touch) != FunctionId::kNull && trigger.get(fields::solid) == kSolidTrigger &&
         world::boxes_meet(box, linked_box(trigger));
}

// Brush models block as if they were never turned, unless the mod has asked for it (DP_SV_ROTATINGBMODEL).
bool is_turned(const Level& level, const Edict& edict) {
  return level.asked.rotating_pushers && edict.get(fields::solid) == kSolidBsp &&
         edict.get(fields::angles) != vec3(0.0f);
}

// QuakeSpasm ends the game where a SOLID_BSP edict has no brush model. Here it blocks as its box does: a model that
// could not be read ends nothing either.
const BrushModel* solid_brush_model(Level& level, const Edict& edict) {
  if (edict.get(fields::solid) != kSolidBsp) return nullptr;
  const BrushModel* const model = brush_model_of(level, edict);
  if (!model) {
    level.warn_once(fmt::format("{} is SOLID_BSP, but its model \"{}\" has no hulls; its bounding box blocks instead",
                                level.vm->text(edict.get(fields::classname)),
                                level.vm->text(edict.get(fields::model))));
  }
  return model;
}

// SV_ClipMoveToEntity.
MoveTrace clip_move_to_entity(Level& level, const Edict& edict, const world::Move& move) {
  MoveTrace trace;
  const vec3 origin = edict.get(fields::origin);
  if (const BrushModel* const model = solid_brush_model(level, edict)) {
    static_cast<world::Trace&>(trace) = clip_move_to_brush_model(level, edict, *model, move);
  } else {
    static_cast<world::Trace&>(trace) =
        world::clip_move_to_box(origin, edict.get(fields::mins), edict.get(fields::maxs), move);
  }
  if (trace.fraction < 1.0f || trace.start_solid) trace.edict = edict.id();
  return trace;
}

MoveTrace clip_move_to_world(Level& level, const world::Move& move) {
  MoveTrace trace;
  static_cast<world::Trace&>(trace) = world::clip_move_to_model(*level.hulls, 0, vec3(0.0f), move);
  if (trace.fraction < 1.0f || trace.start_solid) trace.edict = EdictId::kWorld;
  return trace;
}

// How much wider a missile is to monsters.
constexpr float kMissileHalf = 15.0f;

// SV_ClipToLinks for one move.
class MoveClip {
 public:
  MoveClip(Level& level, const world::Move& move, MoveKind kind, std::optional<EdictId> pass)
      : level_(level), move_(move), to_monsters_(move), kind_(kind), pass_(pass) {
    if (kind == MoveKind::kMissile) {
      to_monsters_.mins = vec3(-kMissileHalf);
      to_monsters_.maxs = vec3(kMissileHalf);
    }
    if (!pass) return;
    const Edict passed = level.edict(*pass);
    pass_has_size_ = passed.get(fields::size).x != 0.0f;
    pass_owner_ = passed.get(fields::owner);
  }

  MoveTrace run() {
    trace_ = clip_move_to_world(level_, move_);
    box_ = world::move_bounds(to_monsters_);
    level_.areas.visit(world::AreaList::kSolid, box_, [&](int id) {
      clip_to(edict_id(id));
      return !trace_.all_solid;
    });
    return trace_;
  }

 private:
  void clip_to(EdictId id) {
    const Edict touched = level_.edict(id);
    if (!may_meet(touched)) return;
    const bool monster = touched.has_flag(fields::flags, kFlagMonster);
    const MoveTrace next = clip_move_to_entity(level_, touched, monster ? to_monsters_ : move_);
    if (merge_trace(trace_, next)) trace_.edict = next.edict;
  }

  // QuakeC may have changed what is solid, and how, since the edict was linked.
  bool may_meet(const Edict& touched) const {
    const auto solid = touched.get(fields::solid);
    if (solid == kSolidNot || solid == kSolidTrigger || touched.id() == pass_) return false;
    if (kind_ == MoveKind::kNoMonsters && solid != kSolidBsp) return false;
    if (is_volume(level_, touched)) return false;
    if (!world::boxes_meet(box_, linked_box(touched))) return false;
    if (!pass_) return true;
    if (pass_has_size_ && touched.get(fields::size).x == 0.0f) return false;  // points never meet
    return touched.get(fields::owner) != *pass_ && pass_owner_ != touched.id();
  }

  Level& level_;
  const world::Move& move_;
  world::Move to_monsters_;
  MoveKind kind_;
  std::optional<EdictId> pass_;
  bool pass_has_size_ = false;
  EdictId pass_owner_ = EdictId::kWorld;
  Bounds box_;
  MoveTrace trace_;
};

}  // namespace

Bounds linked_box(const Edict& edict) {
  Bounds box;
  box.min = edict.get(fields::absmin);
  box.max = edict.get(fields::absmax);
  return box;
}

std::string describe(Level& level, EdictId id) {
  const Edict edict = level.edict(id);
  const vec3 at = edict.get(fields::origin);
  return fmt::format("edict {} ({} at {} {} {})", index(id), level.vm->text(edict.get(fields::classname)), at.x, at.y,
                     at.z);
}

void unlink_edict(Level& level, EdictId id) { level.areas.unlink(list_id(id)); }

void link_edict(Level& level, EdictId id, bool touch_triggers) {
  unlink_edict(level, id);
  Edict edict = level.edict(id);
  if (edict.is_world() || edict.is_free()) return;
  const bool item = edict.has_flag(fields::flags, kFlagItem);
  const vec3 wider = item ? vec3(15.0f, 15.0f, 0.0f) : vec3(1.0f);
  const vec3 origin = edict.get(fields::origin);
  Bounds own;
  own.min = edict.get(fields::mins);
  own.max = edict.get(fields::maxs);
  if (is_turned(level, edict)) own = transform_bounds(entity_transform(vec3(0.0f), edict.get(fields::angles)), own);
  edict.set(fields::absmin, origin + own.min - wider);
  edict.set(fields::absmax, origin + own.max + wider);
  const Bounds box = linked_box(edict);

  level.extra(id).leafs =
      edict.get(fields::modelindex) != 0.0f ? world::touched_leafs(*level.bsp, box) : world::TouchedLeafs{};
  if (edict.get(fields::solid) == kSolidNot) return;
  const bool trigger = edict.get(fields::solid) == kSolidTrigger;
  level.areas.link(list_id(id), trigger ? world::AreaList::kTrigger : world::AreaList::kSolid, box);
  if (touch_triggers) touch_links(level, id);
}

// QuakeSpasm lists the triggers before the first is touched, and asks again before each, as the earlier ones may have
// moved it, or the thing, away.
void touch_links(Level& level, EdictId id) {
  const Edict edict = level.edict(id);
  std::vector<EdictId> triggers;
  level.areas.visit(world::AreaList::kTrigger, linked_box(edict), [&](int other) {
    const Edict trigger = level.edict(edict_id(other));
    if (trigger.id() != id && is_touched_by(trigger, linked_box(edict))) triggers.push_back(trigger.id());
    return true;
  });
  for (const EdictId trigger : triggers) {
    if (!is_touched_by(level.edict(trigger), linked_box(edict))) continue;
    const KeepSelfAndOther keep(*level.vm);
    if (!level.run(level.edict(trigger).get(fields::touch), trigger, id)) return;
  }
}

MoveTrace sv_move(Level& level, const world::Move& move, MoveKind kind, std::optional<EdictId> pass) {
  return MoveClip(level, move, kind, pass).run();
}

MoveTrace move_edict(Level& level, EdictId id, const vec3& end, MoveKind kind) {
  const Edict edict = level.edict(id);
  const world::Move move{edict.get(fields::origin), edict.get(fields::mins), edict.get(fields::maxs), end};
  return sv_move(level, move, kind, id);
}

bool in_solid(Level& level, EdictId id) {
  return move_edict(level, id, level.edict(id).get(fields::origin)).start_solid;
}

std::int32_t point_contents(Level& level, const vec3& point) {
  const std::int32_t contents = world::sv_point_contents(*level.hulls, point);
  return contents == formats::kContentsEmpty ? volume_contents(level, point).value_or(contents) : contents;
}

const BrushModel* brush_model_of(const Level& level, const Edict& edict) {
  const int number = enum_of(edict, fields::modelindex);
  if (number <= 0 || static_cast<std::size_t>(number) >= level.models.size()) return nullptr;
  const auto& brush = level.models[static_cast<std::size_t>(number)].brush;
  return brush ? &*brush : nullptr;
}

world::Trace clip_move_to_brush_model(const Level& level, const Edict& edict, const BrushModel& model,
                                      const world::Move& move) {
  const vec3 origin = edict.get(fields::origin);
  if (!is_turned(level, edict)) return world::clip_move_to_model(*model.hulls, model.index, origin, move);
  return world::clip_move_to_turned_model(*model.hulls, model.index, origin, edict.get(fields::angles), move);
}

}  // namespace fb::sv
