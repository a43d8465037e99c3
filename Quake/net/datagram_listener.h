// A server's listener: answers NetQuake's connection control on the game's port, and returns a connection for each
// client, on a port of its own, as in NetQuake.
//
// The sender of a request may be forged. So a reply to a stranger is at most kMostReply times as long as the request,
// replies are limited (RateLimit), and a request changes no connection: it only makes one that is proven once a packet
// has come from the sender to the port that it was given. Until then it takes no player's slot.
//
// A proven newcomer is handed out by accept() when there is a slot for it. It replaces
// - the connection of its own address and port, and
// - one of another port of its host that has been silent for kSilent: a player is back after a crash.
// On a full server it waits for that: a player who is there says something at least every five seconds, one who has
// crashed does not. So that no host holds all slots without playing, at most half of them (two at least) may be signing
// on from one host; the next wait for kLongestWait. set_most_per_host() limits those who play as well.
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
  static constexpr std::size_t kMostReply = 8;                  // times the request
  static constexpr double kSilent = 10.0, kLongestWait = 30.0;  // seconds
  static constexpr std::size_t kMostPending = 64;               // unproven
  static constexpr std::size_t kMostWaiting = 32, kMostWaitingOfHost = 16;

  // Listens with IPv4 and, if the system has it, IPv6. The network must outlive this object; `status` is called for
  // each query and request. Fails if the port cannot be opened at all. `seed`: any number that others cannot guess.
  static Result<std::unique_ptr<DatagramListener>> open(Network& network, std::uint16_t port, StatusSource status,
                                                        std::uint64_t seed);
  ~DatagramListener() override;

  std::unique_ptr<Connection> accept(double now) override;
  std::uint16_t port() const { return sockets_.front()->port(); }
  // Timeout of new connections: net_messagetimeout.
  void set_timeout(double seconds) { timeout_ = seconds; }
  // Connections that one host may have; 0: any number.
  void set_most_per_host(int count) { most_per_host_ = count; }

 private:
  DatagramListener(Network& network, std::vector<std::unique_ptr<Socket>> sockets, StatusSource status,
                   std::uint64_t seed);
  void read_requests(Socket& socket, double now);
  void answer(Socket& socket, const Address& to, std::size_t request_size, const ControlReply& reply);
  void answer_request(Socket& socket, const Address& from, std::size_t size, const ControlRequest& request, double now);
  void answer_connect(Socket& socket, const Address& from, std::size_t size, const ccreq::Connect& request, double now);
  void make_room_for_pending();
  void take_proven(double now);
  std::unique_ptr<Connection> hand_out(double now);

  using Peer = DatagramConnection::Peer;
  // Proven, and without a slot yet.
  struct Newcomer {
    std::unique_ptr<DatagramConnection> connection;
    double since = 0.0;
    bool replaces = false;  // one who has gone: the slot is this one's
    const Address& address() const { return connection->peer()->address; }
  };
  enum class Verdict { kComesIn, kWaits, kNoRoom, kTooManyOfHost };
  Verdict judge(Newcomer& newcomer, const ServerStatus& status, double now);
  void forget_closed();
  double silence(const Peer& peer, double now) const;
  std::shared_ptr<Peer> most_silent(const Address& host, double now) const;

  Network& network_;
  std::vector<std::unique_ptr<Socket>> sockets_;
  StatusSource status_;
  RateLimit limit_;
  double timeout_ = kDefaultTimeout;
  int most_per_host_ = 0;
  double polled_ = 0.0, awake_since_ = 0.0;  // when accept() was called last; since when without a pause
  std::vector<std::unique_ptr<DatagramConnection>> pending_;  // unproven, oldest first
  std::vector<Newcomer> waiting_;                             // oldest first
  std::vector<std::shared_ptr<Peer>> connected_;              // as handed out
};

}  // namespace fb::net
