#include "server/simulation/skin_contents.h"

#include "server/simulation/link.h"
#include "server/simulation/quakec.h"

namespace fb::sv {
namespace {

// Whether a box is inside of an edict that has contents by its skin: of its model, where that is made of brushes.
bool holds(Level& level, const Edict& volume, const Bounds& box) {
  if (!world::boxes_meet(box, linked_box(volume))) return false;
  const BrushModel* const model = brush_model_of(level, volume);
  if (!model) return true;
  const vec3 middle = (box.min + box.max) * 0.5f, half = (box.max - box.min) * 0.5f;
  const world::Move stay{middle, -half, half, middle};
  return clip_move_to_brush_model(level, volume, *model, stay).start_solid;
}

// Calls found(edict, contents) for each that holds the box, until that returns false.
template <typename Found>
void visit_volumes(Level& level, const Bounds& box, Found&& found) {
  if (!level.asked.skin_contents) return;
  for (const auto list : {world::AreaList::kSolid, world::AreaList::kTrigger}) {
    const bool all = level.areas.visit(list, box, [&](int id) {
      const Edict edict = level.edict(EdictId{static_cast<std::uint32_t>(id)});
      const auto contents = skin_contents(level, edict);
      return !contents || !holds(level, edict, box) || found(*contents);
    });
    if (!all) return;
  }
}

bool is_current(std::int32_t contents) {
  return contents <= formats::kContentsCurrent0 && contents >= formats::kContentsCurrentDown;
}

}  // namespace

std::optional<std::int32_t> skin_contents(const Level& level, const Edict& edict) {
  if (!level.asked.skin_contents || !(edict.get(fields::skin) < 0.0f)) return std::nullopt;
  const int solid = enum_of(edict, fields::solid);
  if (solid != kSolidBsp && solid != kSolidTrigger) return std::nullopt;
  return enum_of(edict, fields::skin);
}

bool is_volume(const Level& level, const Edict& edict) {
  const auto contents = skin_contents(level, edict);
  return contents && *contents != formats::kContentsSolid && *contents != formats::kContentsClip;
}

std::optional<std::int32_t> volume_contents(Level& level, const vec3& point) {
  std::optional<std::int32_t> result;
  Bounds box;
  box.add(point);
  visit_volumes(level, box, [&](std::int32_t contents) {
    if (contents == kContentsLadder || contents == formats::kContentsEmpty) return true;
    result = is_current(contents) ? static_cast<std::int32_t>(formats::kContentsWater) : contents;
    return false;
  });
  return result;
}

bool on_ladder(Level& level, EdictId id) {
  bool found = false;
  visit_volumes(level, linked_box(level.edict(id)), [&](std::int32_t contents) {
    found = contents == kContentsLadder;
    return !found;
  });
  return found;
}

}  // namespace fb::sv
