// What a server reports about itself to anybody.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace fb::net {

struct PlayerStatus {
  std::string name;
  int colors = 0, frags = 0;  // colors: shirt in the high four bits, trousers in the low four
  double seconds = 0.0;       // since it connected
};
struct ServerStatus {
  std::string name, map;  // cvar hostname; "start"
  int max_players = 1;
  std::vector<PlayerStatus> players;
  std::vector<std::pair<std::string, std::string>> rules;  // server cvars
};
using StatusSource = std::function<ServerStatus()>;

}  // namespace fb::net
