// The connection of a single-player game: two ends inside the program, with Quake's rules. A reliable message blocks
// the next one until the other end has received it; unreliable messages are dropped once too much is waiting at the
// other end.
#pragma once

#include <deque>
#include <memory>
#include <utility>

#include "net/connection.h"

namespace fb::net {

// Both ends of a new connection. Either may be destroyed first; the other can still receive what was sent.
std::pair<std::unique_ptr<Connection>, std::unique_ptr<Connection>> make_loopback(double now);

class LoopbackListener final : public Listener {
 public:
  // The client's end; accept() returns the server's.
  std::unique_ptr<Connection> connect(double now);
  std::unique_ptr<Connection> accept(double now) override;

 private:
  std::deque<std::unique_ptr<Connection>> waiting_;
};

}  // namespace fb::net
