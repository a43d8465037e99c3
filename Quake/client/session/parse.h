// Understanding what a server says: svc_* messages become the session's state.
#pragma once

#include <string_view>

#include "base/bytes.h"
#include "base/result.h"
#include "client/session/session.h"

namespace fb::cl {

// Applies one datagram. `name` is what errors call it. On an error the session holds what came before it.
// svc_disconnect sets session.disconnected and ends the datagram.
Status parse_server_message(Session& session, ByteView data, std::string_view name);

// The colour flash of something picked up (svc_bf and the command bf).
void bonus_flash(ClientState& state);
// v_cshift: red, green, blue, percent (0..255 each).
void set_empty_shift(ClientState& state, const vec3& color, float percent);

}  // namespace fb::cl
