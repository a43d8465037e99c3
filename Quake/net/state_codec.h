// The largest messages of a game, whose layout depends on bits: baselines, entity updates, client data. Used by
// server_messages.cpp only. Readers do not check for the end of the message: their caller checks once.
#pragma once

#include "net/message.h"
#include "net/server_messages.h"

namespace fb::net {

EntityState read_baseline(MessageReader& reader, bool extended);
void write_baseline(MessageWriter& writer, const EntityState& state, bool extended);

// `command` is the byte that announced the update: 128 and the first bits.
svc::EntityUpdate read_update(MessageReader& reader, unsigned command);
// With the command byte.
void write_update(MessageWriter& writer, const svc::EntityUpdate& update);

svc::ClientData read_client_data(MessageReader& reader);
// With the command byte.
void write_client_data(MessageWriter& writer, const svc::ClientData& data);

}  // namespace fb::net
