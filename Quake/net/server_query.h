// Queries of servers: `slist` asks all on the local network, `status ADDRESS` one server for its players and rules.
// Neither blocks: poll them every frame until they are done. Replies are untrusted text: print them as data.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "net/control.h"
#include "net/network.h"
#include "net/server_status.h"

namespace fb::net {

struct FoundServer {
  Address address;
  std::string name, map;
  int players = 0, max_players = 0;
  bool compatible = true;  // has the same version of connection control
};

class ServerSearch {
 public:
  static constexpr std::size_t kMostServers = 256;

  // Queries each of `targets`, which may be broadcast(port), twice, because packets get lost.
  ServerSearch(Network& network, std::vector<Address> targets);
  // Returns false when it is over, 1.5 seconds after the first call.
  bool poll(double now);
  // In the order of their answers, each address once.
  const std::vector<FoundServer>& found() const { return found_; }

 private:
  void ask();
  void take_replies(Socket& socket);

  std::vector<Address> targets_;
  std::vector<std::unique_ptr<Socket>> sockets_;
  std::vector<FoundServer> found_;
  int asked_ = 0;
  double started_ = 0.0;
};

// Queries one server: first about itself, then its players and rules.
class ServerInquiry {
 public:
  ServerInquiry(Network& network, const Address& server);
  // Returns false when all is known or no more will come (3 seconds after the first call).
  bool poll(double now);
  bool answered() const { return answered_; }
  // Players and rules whose replies were lost are missing.
  ServerStatus status() const;

 private:
  void ask_for_missing(double now);
  void take_reply(const ControlReply& reply, double now);

  Address server_;
  std::unique_ptr<Socket> socket_;
  bool answered_ = false, all_rules_ = false;
  int player_count_ = 0;
  ServerStatus status_;
  std::map<int, PlayerStatus> players_;
  double started_ = -1.0, next_ask_ = 0.0;
};

}  // namespace fb::net
