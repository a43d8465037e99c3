// svc_temp_entity: events without an entity (impacts, explosions, beams).
#pragma once

#include "client/effects/effects.h"
#include "net/server_messages.h"

namespace fb::cl {

void apply_temp_entity(Effects& effects, const net::svc::TempEntity& message, double time);

}  // namespace fb::cl
