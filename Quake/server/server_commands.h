// The console's commands of a server. Not for users of the server.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/server.h"

namespace fb::sv {

struct Server::Commands {
  Commands(Server& server, const ServerOptions& options);
  ~Commands();  // takes them away again

 private:
  void add(std::string name, std::string help, con::Handler handler);
  void add_game_commands();
  void restart(const con::Args& args);
  double gone_back_to_ = -1.0;  // the level's time to which `restart` has last gone back by loading a save
  void add_save_commands();
  void add_edict_commands();
  void add_player_commands();

  Server& server_;
  std::vector<std::string> names_;
};

}  // namespace fb::sv
