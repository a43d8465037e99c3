#include "host/game/server_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"

namespace fb::host {

std::string plain_text(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (c >= ' ' && c <= '~') letters.push_back(c);
  return letters;
}

ServerList::ServerList(con::Console& console, net::Network& network) : network_(network) {
  console.add_command("slist", "slist [address ...]: list the servers on the local network, or at these addresses",
                      [this, &console](const con::Args& args) { console.fail_unless(begin(args)); });
}

Status ServerList::begin(const con::Args& args) {
  if (search_) return ok_status();
  std::vector<net::Address> targets;
  for (std::size_t i = 1; i < args.size(); ++i) {
    const auto address = network_.resolve(args[i]);
    if (!address) return Error{fmt::format("slist: {}", address.error().message)};
    targets.push_back(*address);
  }
  if (targets.empty()) targets.push_back(net::broadcast(net::kDefaultPort));
  log_info("Looking for Quake servers...");
  search_ = std::make_unique<net::ServerSearch>(network_, std::move(targets));
  return ok_status();
}

void ServerList::poll(double now) {
  if (!search_ || search_->poll(now)) return;
  found_ = search_->found();
  log_info("{}", server_table(found_));
  search_.reset();
}

std::string server_table(const std::vector<net::FoundServer>& servers) {
  if (servers.empty()) return "No Quake servers found.";
  std::string table = "Server          Map             Users\n--------------- --------------- -----\n";
  for (const net::FoundServer& server : servers) {
    table += fmt::format("{:<15.15} {:<15.15} {:2}/{:2}  {}{}\n", plain_text(server.name), plain_text(server.map),
                         server.players, server.max_players, server.address.to_string(),
                         server.compatible ? "" : " (speaks another version)");
  }
  return table + "== end list ==";
}

}  // namespace fb::host
