// What messages say of entities: baselines, updates, statics.
#pragma once

#include <string>

#include "client/session/session.h"

namespace fb::cl {

// All three return why the message cannot be obeyed, or an empty string.
std::string apply_update(Session& session, const net::svc::EntityUpdate& update);
std::string apply_baseline(ClientState& state, const net::svc::SpawnBaseline& baseline);
std::string apply_static(ClientState& state, const net::svc::SpawnStatic& message);

}  // namespace fb::cl
