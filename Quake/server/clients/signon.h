// What a player is told of a level before it is in it: the lists of models and sounds, and how things stand at first.
#pragma once

#include <string_view>

#include "net/server_messages.h"
#include "server/simulation/level.h"

namespace fb::sv {

// Protocol 15 numbers models and sounds with a byte: what is beyond is left out, as QuakeSpasm does, with a warning.
net::svc::ServerInfo server_info(const Level& level, const net::Protocol& protocol, int max_clients);

// Gives every edict that can be seen its baseline and writes it (SV_CreateBaseline); players look like
// progs/player.mdl.
void make_baselines(Level& level, net::MessageWriter& writer);

// As the thing stands now, or nothing where it cannot be shown: invisible, or beyond protocol 15's numbers
// (makestatic).
std::optional<net::svc::SpawnStatic> static_entity(Level& level, EdictId id, const net::Protocol& protocol);

}  // namespace fb::sv
