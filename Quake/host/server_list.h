// slist: who serves on the local network, or at the addresses that are given; asked without holding up anything.
#pragma once

#include <memory>

#include "base/result.h"
#include "console/console.h"
#include "net/server_query.h"

namespace fb::host {

class ServerList {
 public:
  // Registers slist. Both must outlive this, and the console must not execute it afterwards.
  ServerList(con::Console& console, net::Network& network);
  // Every frame. Prints what was found when the time is over.
  void poll(double now);
  bool searching() const { return search_ != nullptr; }

 private:
  Status begin(const con::Args& args);

  net::Network& network_;
  std::unique_ptr<net::ServerSearch> search_;
};

// QuakeSpasm's table: a head, a line a server.
std::string server_table(const std::vector<net::FoundServer>& servers);

}  // namespace fb::host
