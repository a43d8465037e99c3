// Where what the client shows comes from: one of these at a time, each with what belongs to it alone.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "client/sources/demo.h"
#include "client/sources/server_link.h"
#include "net/connect_attempt.h"

namespace fb::cl {

struct NoSource {};
// A map without messages: nothing happens in it, but time passes.
struct StillMap {};
// A server that has been asked for a game and has not answered yet. A map that was shown stays in view, and is what
// remains if nobody answers.
struct AskedServer {
  std::unique_ptr<net::ConnectAttempt> attempt;
  std::string name;
  bool over_map = false;
};

using MessageSource = std::variant<NoSource, StillMap, AskedServer, DemoPlayback, ServerLink>;

}  // namespace fb::cl
