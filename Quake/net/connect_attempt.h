// A client's attempt to connect: sends a request every 2.5 seconds, three times, then uses the port that the server
// names. Never blocks: poll it every frame.
#pragma once

#include <memory>
#include <string>

#include "net/connection.h"
#include "net/network.h"

namespace fb::net {

class ConnectAttempt {
 public:
  enum class State { kTrying, kConnected, kFailed };

  // The network must outlive this.
  ConnectAttempt(Network& network, const Address& server);

  State poll(double now);
  // Timeout of the connection: net_messagetimeout.
  void set_timeout(double seconds) { timeout_ = seconds; }
  // Only once connected.
  std::unique_ptr<Connection> take() { return std::move(connection_); }
  // Only once failed, for people: "no response", the server's own words, or the system's error.
  const std::string& failure() const { return failure_; }
  int tries() const { return tries_; }

 private:
  State fail(std::string why);
  State take_reply(ByteView datagram, double now);

  Address server_;
  std::unique_ptr<Socket> socket_;
  State state_ = State::kTrying;
  int tries_ = 0;
  double timeout_ = kDefaultTimeout;
  double next_try_ = 0.0;
  std::string failure_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace fb::net
