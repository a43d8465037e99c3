// Single player's connection: two ends within the program, with Quake's rules. A reliable message blocks the next one
// until the other end has received it; what is unreliable is dropped once too much waits at the other end.
#pragma once

#include <deque>
#include <memory>
#include <utility>

#include "net/connection.h"

namespace fb::net {

// Both ends of a new connection. Either may go first; what had been sent can still be received then.
std::pair<std::unique_ptr<Connection>, std::unique_ptr<Connection>> make_loopback(double now);

class LoopbackListener final : public Listener {
 public:
  // The client's end; the server's comes out of accept().
  std::unique_ptr<Connection> connect(double now);
  std::unique_ptr<Connection> accept(double now) override;

 private:
  std::deque<std::unique_ptr<Connection>> waiting_;
};

}  // namespace fb::net
