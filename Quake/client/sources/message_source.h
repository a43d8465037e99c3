// The source of what the client shows: exactly one of these at a time, each with its own state.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "client/sources/demo.h"
#include "client/sources/server_link.h"
#include "net/connect_attempt.h"

namespace fb::cl {

struct NoSource {};
// A map without a server: there are no messages; only time passes.
struct StillMap {};
// A connection request that has no answer yet. A still map stays visible meanwhile, and afterwards if no answer comes.
struct AskedServer {
  std::unique_ptr<net::ConnectAttempt> attempt;
  std::string name;
  bool over_map = false;
};

using MessageSource = std::variant<NoSource, StillMap, AskedServer, DemoPlayback, ServerLink>;

}  // namespace fb::cl
