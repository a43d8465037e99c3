// slist: lists the servers on the local network, or at given addresses, without blocking the game.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "console/console.h"
#include "net/server_query.h"

namespace fb::host {

class ServerList {
 public:
  // Registers slist. Console and network must outlive this object, and the console must not execute slist afterwards.
  ServerList(con::Console& console, net::Network& network);
  // Call every frame. Prints the servers found when the time is over.
  void poll(double now);
  bool searching() const { return search_ != nullptr; }
  // Of the search that goes on, else of the last one.
  const std::vector<net::FoundServer>& found() const { return search_ ? search_->found() : found_; }

 private:
  Status begin(const con::Args& args);

  net::Network& network_;
  std::unique_ptr<net::ServerSearch> search_;
  std::vector<net::FoundServer> found_;
};

// Keeps the printable ASCII characters of untrusted text.
std::string plain_text(std::string_view text);

// QuakeSpasm's table: a heading, then one line for each server.
std::string server_table(const std::vector<net::FoundServer>& servers);

}  // namespace fb::host
