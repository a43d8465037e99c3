// FTE_ENT_SKIN_CONTENTS: a brush model, or a trigger's box, whose skin is negative holds those contents instead of
// being solid: water that is moved about (-3), slime, lava, a ladder (-16). Only for mods that have asked for the
// extension: others may have put anything into skin.
#pragma once

#include <optional>

#include "server/simulation/level.h"

namespace fb::sv {

constexpr std::int32_t kContentsLadder = -16;

// What an edict holds by its skin; nothing where that says nothing.
std::optional<std::int32_t> skin_contents(const Level& level, const Edict& edict);
// Whether it is in nobody's way for that.
bool is_volume(const Level& level, const Edict& edict);
// What such edicts hold at a point, currents as water; nothing where there is none. Ladders are no liquids.
std::optional<std::int32_t> volume_contents(Level& level, const vec3& point);
// Whether an edict's box is in a ladder.
bool on_ladder(Level& level, EdictId id);

}  // namespace fb::sv
