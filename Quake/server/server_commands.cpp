#include "server/server_commands.h"

#include <fmt/format.h>

#include "base/log.h"
#include "base/number.h"
#include "fs/path.h"
#include "progs/entity_text.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;

constexpr double kMostRunSeconds = 1e9;  // a client's time ends there

double run_step(const con::Console& console) {
  const con::Cvar* fixed = console.find_cvar("host_framerate");
  return fixed && fixed->value() > 0.0f ? static_cast<double>(fixed->value()) : 0.1;
}

void print_counts(Level& level) {
  int active = 0, seen = 0, touching = 0, stepping = 0;
  for (EdictId id{}; level.edicts().valid(id); id = next(id)) {
    const Edict edict = level.edict(id);
    if (edict.is_free()) continue;
    ++active;
    seen += edict.get(fields::model) != StringId::kNull ? 1 : 0;
    touching += edict.get(fields::solid) != 0.0f ? 1 : 0;
    stepping += edict.get(fields::movetype) == static_cast<float>(kMoveStep) ? 1 : 0;
  }
  log_info("num_edicts:{:3}\nactive    :{:3}\nview      :{:3}\ntouch     :{:3}\nstep      :{:3}",
           level.edicts().count(), active, seen, touching, stepping);
}

void print_profile(Level& level) {
  constexpr std::size_t kRows = 10;
  for (const progs::ProfileRow& row : level.vm->take_profile(kRows))
    log_info("{:7} {}", row.statements, level.vm->function_name(row.function));
}

}  // namespace

Server::Commands::Commands(Server& server, const ServerOptions& options) : server_(server) {
  add_game_commands();
  add_save_commands();
  add_edict_commands();
  if (options.dedicated) add_player_commands();
}

Server::Commands::~Commands() {
  for (const std::string& name : names_) server_.console_.remove_command(name);
}

void Server::Commands::add(std::string name, std::string help, con::Handler handler) {
  names_.push_back(name);
  server_.console_.add_command(std::move(name), std::move(help), std::move(handler));
}

void Server::Commands::add_game_commands() {
  Server& server = server_;
  con::Console& console = server_.console_;
  add("map", "map <name>: start a new game on a map", [&server, &console](const con::Args& args) {
    if (args.size() == 2) return console.fail_unless(server.map(args[1]));
    if (server.active()) return log_info("the level is {}", server.level()->map_name);
    log_info("map <name>: start a new game on a map");
  });
  add("changelevel", "changelevel <map>: go to another map with all players",
      [&server, &console](const con::Args& args) {
        if (args.size() < 2) return log_info("changelevel <map>: go to another map with all players");
        console.fail_unless(server.changelevel(args[1]));
      });
  add("restart",
      "restart [level]: start the level over; for a dead player the level's last save is loaded instead (sv_autoload), "
      "unless \"level\" says otherwise",
      [this](const con::Args& args) { restart(args); });
  add("maxplayers", "maxplayers <n>: set the number of player slots (1 to 16); between games only",
      [&server, &console](const con::Args& args) {
        if (args.size() != 2) return log_info("maxplayers is {}", server.max_clients());
        const auto count = whole_number_in<int>("maxplayers", args[1], 1, net::kMaxClients);
        if (!count) return console.fail_unless(count.error());
        if (const Status status = server.set_max_clients(*count); !status) return console.fail_unless(status);
        console.set("deathmatch", server.max_clients() == 1 ? "0" : "1");
      });
  add("sv_run",
      "sv_run <seconds>: simulate the game as fast as possible, in steps of host_framerate or, if that is 0, 0.1 s",
      [&server, &console](const con::Args& args) {
        if (args.size() != 2) return log_info("sv_run <seconds>: simulate the game as fast as possible");
        const auto seconds = number_in("sv_run", args[1], 0.0, kMostRunSeconds);
        if (!seconds) return console.fail_unless(seconds.error());
        if (!server.active()) return console.fail("sv_run: no game runs here");
        console.fail_unless(server.run(*seconds, run_step(console)));
      });
  add("sv_dump", "sv_dump [file]: write the level's whole state as text, as FILE.txt",
      [&server, &console](const con::Args& args) {
        if (!server.active()) return console.fail("sv_dump: no game runs here");
        const std::string text = server.dump();
        if (args.size() < 2 || args[1].empty()) return log_info("{}", text);
        if (!server.services_.write_file) {
          return console.fail(fmt::format("sv_dump {}: there is nowhere to write to", args[1]));
        }
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
        // QuakeC may say this, too: not over a configuration or a pak.
        const std::string name = fs::ends_with_ignoring_case(args[1], ".txt") ? args[1] : args[1] + ".txt";
        console.fail_unless(server.services_.write_file(name, ByteView(bytes, text.size())));
      });
}

// QuakeC says `restart` when a dead player wants to go on, once a tick until it is obeyed: a long frame holds several.
void Server::Commands::restart(const con::Args& args) {
  con::Console& console = server_.console_;
  const auto waits_at = [&] { return server_.level_ && server_.level_->loaded ? server_.level_->time : -1.0; };
  if (args.size() == 1 && server_.active() && gone_back_to_ >= 0.0 && waits_at() == gone_back_to_) return;
  const std::string save = args.size() > 1 ? std::string() : server_.save_after_death();
  const float autoload = console.cvar("sv_autoload").value();
  if (!save.empty() && autoload == 1.0f && server_.offer_load_) return server_.offer_load_(save);
  if (!save.empty() && autoload >= 2.0f) {
    const Status loaded = server_.load(save);
    if (loaded) gone_back_to_ = waits_at();
    if (loaded || !server_.active()) return console.fail_unless(loaded);
    log_error("{}", loaded.error().message);  // the file is gone: the level is there still
  }
  console.fail_unless(server_.restart());
}

void Server::Commands::add_save_commands() {
  Server& server = server_;
  con::Console& console = server_.console_;
  add("save", "save <name>: save the game", [&server, &console](const con::Args& args) {
    if (args.size() != 2) return log_info("save <name>: save the game");
    const Status status = server.save(args[1]);
    if (!status) return console.fail_unless(status);
    log_info("saved as {}", args[1]);
  });
  add("load", "load <name>: load a saved game", [&server, &console](const con::Args& args) {
    if (args.size() != 2) return log_info("load <name>: load a saved game");
    console.fail_unless(server.load(args[1]));
  });
}

void Server::Commands::add_edict_commands() {
  // A command that needs a level.
  const auto add_for_level = [this](std::string name, std::string help, auto handler) {
    add(std::move(name), std::move(help), [&server = server_, handler](const con::Args& args) {
      if (!server.active()) return log_info("{}: no game runs here", args[0]);
      handler(*server.level(), args);
    });
  };
  add_for_level("edict", "edict <number>: print the fields of one edict", [](Level& level, const con::Args& args) {
    const std::uint32_t last = static_cast<std::uint32_t>(level.edicts().count()) - 1;
    if (args.size() != 2) return log_info("edict <number>: numbers are 0 to {}", last);
    const auto number = whole_number_in<std::uint32_t>("edict", args[1], 0, last);
    if (!number) return log_info("{}", number.error().message);
    log_info("{}", progs::print_edict(*level.vm, EdictId{*number}));
  });
  add_for_level("edicts", "edicts: print the fields of all edicts", [](Level& level, const con::Args&) {
    log_info("{} entities", level.edicts().count());
    for (EdictId id{}; level.edicts().valid(id); id = next(id)) log_info("{}", progs::print_edict(*level.vm, id));
  });
  add_for_level("edictcount", "edictcount: count the edicts",
                [](Level& level, const con::Args&) { print_counts(level); });
  add_for_level("profile", "profile: list the QuakeC functions that ran the most instructions since the last profile",
                [](Level& level, const con::Args&) { print_profile(level); });
}

// A dedicated server's own console speaks as a player's would.
void Server::Commands::add_player_commands() {
  for (const char* name : {"status", "kick", "ping", "say", "tell"}) {
    add(name, fmt::format("{}: the players' command of this name, for the server's console", name),
        [&server = server_](const con::Args& args) {
          if (server.active()) server.clients_->console_command(args, server.now_);
        });
  }
}

}  // namespace fb::sv
