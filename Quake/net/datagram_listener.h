// A server's listener: answers NetQuake's connection control on the game's port, and returns a connection for each
// client, on a port of its own, as in NetQuake.
//
// No packet is of use for amplifying an attack: a reply to a stranger is at most kMostReply times as long as the
// request, and replies are limited (RateLimit). A client counts as connected once it has sent a packet to the port it
// was given; until then it takes no player's slot. A request from the address and port of a live connection is ignored;
// if that connection has been silent for kSilent, the request replaces it.
//
// NAT: a client behind one needs no setup. A server behind one needs its port forwarded and, because NetQuake answers
// from a new port, that of every client: a server for players outside should have a public address.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "net/connection.h"
#include "net/control.h"
#include "net/datagram_connection.h"
#include "net/network.h"
#include "net/rate_limit.h"
#include "net/server_status.h"

namespace fb::net {

class DatagramListener final : public Listener {
 public:
  static constexpr std::size_t kMostReply = 8;  // times the request
  static constexpr double kSilent = 5.0;        // seconds
  static constexpr std::size_t kMostPending = 64;

  // Listens with IPv4 and, if the system has it, IPv6. The network must outlive this object; `status` is called for
  // each query and request. Fails if the port cannot be opened at all. `seed`: any number that others cannot guess.
  static Result<std::unique_ptr<DatagramListener>> open(Network& network, std::uint16_t port, StatusSource status,
                                                        std::uint64_t seed);
  ~DatagramListener() override;

  std::unique_ptr<Connection> accept(double now) override;
  std::uint16_t port() const { return sockets_.front()->port(); }
  // Timeout of new connections: net_messagetimeout.
  void set_timeout(double seconds) { timeout_ = seconds; }

 private:
  DatagramListener(Network& network, std::vector<std::unique_ptr<Socket>> sockets, StatusSource status,
                   std::uint64_t seed);
  void read_requests(Socket& socket, double now);
  void answer(Socket& socket, const Address& to, std::size_t request_size, const ControlReply& reply);
  void answer_request(Socket& socket, const Address& from, std::size_t size, const ControlRequest& request, double now);
  void answer_connect(Socket& socket, const Address& from, std::size_t size, const ccreq::Connect& request, double now);
  bool knows(const Address& from, double now);
  std::unique_ptr<Connection> take_verified(double now);

  Network& network_;
  std::vector<std::unique_ptr<Socket>> sockets_;
  StatusSource status_;
  RateLimit limit_;
  double timeout_ = kDefaultTimeout;
  std::vector<std::unique_ptr<DatagramConnection>> pending_;  // not yet verified, oldest first
  std::vector<std::weak_ptr<DatagramConnection::Peer>> connected_;
};

}  // namespace fb::net
