// The messages whose layout depends on bits, which are also the largest of a game: baselines, entity updates, client
// data, sounds. Used by the codec only (fields.h, server_messages.cpp). Readers do not check for the end of the
// message: their caller checks once. The caller writes the command byte, except that of an update, which holds its
// first bits.
#pragma once

#include "net/message.h"
#include "net/server_messages.h"

namespace fb::net {

EntityState read_baseline(MessageReader& reader, bool extended);
void write_baseline(MessageWriter& writer, const EntityState& state, bool extended);

svc::EntityUpdate read_update(MessageReader& reader, unsigned command);
void write_update(MessageWriter& writer, const svc::EntityUpdate& update);

svc::ClientData read_client_data(MessageReader& reader);
void write_client_data(MessageWriter& writer, const svc::ClientData& data);

svc::Sound read_sound(MessageReader& reader);
void write_sound(MessageWriter& writer, const svc::Sound& sound);

}  // namespace fb::net
