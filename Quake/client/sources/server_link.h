// A connection to a server as the client uses it: commands wait here until a reliable message may go, keepalives are
// dropped, and it is counted what has been sent. No game state: what messages say is parse.h's business.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/result.h"
#include "net/client_messages.h"
#include "net/connection.h"
#include "net/keepalive.h"

namespace fb::cl {

class ServerLink {
 public:
  static constexpr std::size_t kMostWaiting = 256;    // commands
  static constexpr int kDroppedMoves = 2;             // of a level: they may hold what was pressed on the last one
  static constexpr std::size_t kMessageBytes = 1000;  // as many commands as fit go in one message

  // `name` is what sentences call the server.
  ServerLink(std::unique_ptr<net::Connection> connection, std::string name);
  ~ServerLink();
  ServerLink(ServerLink&&) = default;
  ServerLink& operator=(ServerLink&&) = delete;

  const std::string& name() const { return name_; }
  bool is_local() const { return connection_->is_local(); }
  bool is_open() const { return connection_->is_open(); }
  // For people, once it is not open.
  std::string close_reason() const { return std::string(connection_->close_reason()); }

  // A command as text; it arrives, in order. False where too much waits already.
  bool command(std::string_view text);
  // What waits, as far as it may go now.
  void flush(double now);
  // The next message of the server but its keepalives.
  std::optional<net::ReceivedMessage> receive(double now);
  void send_move(const net::clc::Move& move, const net::Protocol& protocol, double now);
  // A new level has begun.
  void begin_level() { moves_ = 0; }
  // From now on the server hears every five seconds that this client is alive, whatever it computes.
  void keep_alive();
  // Says goodbye and closes.
  void disconnect(double now);

 private:
  std::unique_ptr<net::Connection> connection_;
  std::string name_;
  std::deque<std::string> waiting_;
  int moves_ = 0;
  std::unique_ptr<net::Keepalive> keepalive_;  // goes before the connection
};

}  // namespace fb::cl
