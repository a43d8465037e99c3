// What a player sees of the level's entities, as updates against their baselines (SV_WriteEntitiesToClient).
#pragma once

#include <cstddef>
#include <optional>

#include "net/server_messages.h"
#include "server/simulation/level.h"

namespace fb::sv {

// Which bits of `effects` players are told. Those that mean lights since the re-release of 2021 are other things to
// older mods (explosions in Arcane Dimensions), so they pass only where the mod's own constants say the same
// (QuakeSpasm).
std::int32_t effects_mask(const progs::Vm& vm);

// One edict as it is now. Nothing where it cannot be seen: invisible (alpha) and without effects. Takes over the
// fields alpha and scale into the level's extra.
std::optional<net::svc::EntityUpdate> entity_update(Level& level, EdictId id, const net::Protocol& protocol,
                                                    std::int32_t effects_mask);

// Appends the updates of all that `player` may see: itself always, others by visibility from its eyes. Where they take
// more than `most` bytes, those nearest to it are written, and false is returned; Quake stops at the first that does
// not fit, so that whatever spawned last flickers.
bool write_entities(net::MessageWriter& writer, Level& level, EdictId player, std::size_t most,
                    std::int32_t effects_mask);

}  // namespace fb::sv
