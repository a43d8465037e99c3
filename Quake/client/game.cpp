// The client on a server: connecting, signing on, reading what comes, saying what the player wants, leaving.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/log.h"
#include "client/client_impl.h"
#include "client/session/parse.h"
#include "client/session/sounds.h"
#include "console/console.h"

namespace fb::cl {
namespace {

constexpr std::size_t kMostNameBytes = 15;
constexpr int kMostColor = 13;
constexpr std::string_view kLocal = "local";

// Commands that the client forwards to the server, each with its help.
constexpr std::array<std::array<const char*, 2>, 15> kForwarded = {{
    {"status", "status: describe the game and list its players"},
    {"god", "god: cheat: take no damage"},
    {"notarget", "notarget: cheat: monsters ignore you"},
    {"fly", "fly: cheat: fly"},
    {"noclip", "noclip: cheat: move through walls"},
    {"setpos", "setpos <x> <y> <z> [pitch yaw roll]: cheat: move to this position"},
    {"give",
     "give <item> [amount]: cheat: h health, s n r c shells nails rockets cells, 2 to 9 weapons, a armour, k keys"},
    {"say", "say <text>: send a message to all players"},
    {"say_team", "say_team <text>: send a message to your team"},
    {"tell", "tell <name> <text>: send a message to one player"},
    {"kill", "kill: commit suicide and respawn"},
    {"pause", "pause: pause or resume the game"},
    {"ping", "ping: list each player's latency"},
    {"kick", "kick <name>|# <number> [reason]: remove a player from the game"},
    {"ban", "ban: ban addresses, on servers that can"},
}};

int shirt(int colors) { return std::clamp(colors / 16, 0, kMostColor); }
int trousers(int colors) { return std::clamp(colors % 16, 0, kMostColor); }

}  // namespace

void Client::Impl::connect(std::unique_ptr<net::Connection> connection, std::string server) {
  demo_loop_next = -1;
  end_demo(std::nullopt);
  leave_game(std::nullopt);
  error.reset();
  session.clear();
  session.signon_heard = 0;
  view = {};
  ++games;
  last_server = server;
  const ServerLink& joined = source.emplace<ServerLink>(std::move(connection), std::move(server));
  session.command = nullptr;
  if (joined.is_local()) session.command = [this](std::string_view line) { console.append(std::string(line) + "\n"); };
}

Status Client::Impl::connect_to(std::string_view server) {
  if (server == kLocal) {
    auto connection = local.connect ? local.connect() : nullptr;
    if (!connection) return Error{"connect local: no game runs here (map NAME starts one)"};
    connect(std::move(connection), std::string(server));
    return ok_status();
  }
  if (!network) return Error{fmt::format("connect {}: there is no network", server)};
  const auto address = network->resolve(server);
  if (!address.ok()) return address.error();
  demo_loop_next = -1;
  end_demo(std::nullopt);
  disconnect();
  error.reset();
  AskedServer asking{std::make_unique<net::ConnectAttempt>(*network, *address), std::string(server), shows_map()};
  if (const con::Cvar* timeout = console.find_cvar("net_messagetimeout"))
    asking.attempt->set_timeout(static_cast<double>(timeout->value()));
  source = std::move(asking);
  log_info("Connecting to {} ...", address->to_string());
  return ok_status();
}

void Client::Impl::poll_attempt() {
  AskedServer& server = *asked();
  switch (server.attempt->poll(clock())) {
    case net::ConnectAttempt::State::kTrying:
      break;
    case net::ConnectAttempt::State::kConnected:
      connect(server.attempt->take(), std::move(server.name));
      if (network->any_thread()) link()->keep_alive();
      log_info("Connection accepted");
      break;
    case net::ConnectAttempt::State::kFailed:
      error = Error{fmt::format("Cannot connect to {}: {}", server.name, server.attempt->failure())};
      log_error("{}", error->message);
      stop_asking();
      break;
  }
}

void Client::Impl::stop_asking() {
  if (!asked()) return;
  if (shows_map())
    source = StillMap{};
  else
    source = NoSource{};
}

void Client::Impl::read_server() {
  ServerLink& server = *link();
  while (const auto message = server.receive(clock()))
    if (!take_server_message(message->data)) return;
  if (!server.is_open())
    leave_game(Error{fmt::format("Lost the connection to {}: {}", server.name(), server.close_reason())});
}

// False: the game is over.
bool Client::Impl::take_server_message(ByteView data) {
  last_heard = clock();
  ClientState& state = session.state;
  if (std::exchange(session.reconnect, false)) state.signon = 0;
  const int level = session.levels, signon = state.signon;
  record_message(data);
  const Status status = parse_server_message(session, data, link()->name());
  if (!status.ok()) {
    const bool was_local = link()->is_local();
    leave_game(status.error());
    if (was_local && local.shut_down) local.shut_down();
    return false;
  }
  if (session.disconnected) {
    session.disconnected = false;
    log_info("Server disconnected");
    leave_game(std::nullopt);
    next_demo();
    return false;
  }
  if (session.levels != level) head.clear();
  if (session.levels != level || signon < 2) keep_for_recording(data);
  if (session.signon_heard != 0) reply_to_signon(std::exchange(session.signon_heard, 0));
  return true;
}

// Each stage of the signon asks for the next (CL_SignonReply).
void Client::Impl::reply_to_signon(int signon) {
  ServerLink& server = *link();
  if (signon == 1) {
    server.command("prespawn");
  } else if (signon == 2) {
    const int colors = console.cvar("_cl_color").integer();
    server.command(fmt::format("name {}", con::in_quotes(console.cvar("_cl_name").string())));
    server.command(fmt::format("color {} {}", shirt(colors), trousers(colors)));
    server.command("spawn");
  } else if (signon == 3) {
    server.command("begin");
  }
  server.flush(clock());
}

void Client::Impl::leave_game(std::optional<Error> why) {
  stop_asking();
  stop_recording();
  if (!link()) return;
  source = NoSource{};
  head.clear();
  session.command = nullptr;
  session.forced_track = -1;
  end_sounds(session);
  session.state.signon = 0;
  session.state.hud.intermission = Intermission::kNone;
  snapshots.forget();
  if (why) {
    log_error("{}", why->message);
    error = std::move(why);
  }
}

void Client::Impl::disconnect() {
  const bool was_local = link() && link()->is_local();
  if (link()) link()->disconnect(clock());
  leave_game(std::nullopt);
  if (was_local && local.shut_down) local.shut_down();
}

void Client::Impl::forward(const std::string& text) {
  if (demo()) return;  // as in Quake: a demo is no server
  if (!link()) {
    log_info("Can't \"{}\", not connected", text.substr(0, text.find(' ')));
  } else if (!link()->command(text)) {
    log_info("The server does not take commands any more: \"{}\" is dropped.", text);
  }
}

void Client::Impl::send() {
  ServerLink* const server = link();
  if (!server) return;
  const ClientState& state = session.state;
  if (state.signon == kSignons && !session.reconnect) {
    UserMove pending = stick_move(sticks, stick_settings, input, runs(buttons, input));
    pending.forward += mouse_move.forward;
    pending.side += mouse_move.side;
    const net::clc::Move move = make_move(buttons, input, pending, state.view_angles, state.message_times[0]);
    last_forward = static_cast<float>(move.forward);
    server->send_move(move, state.protocol, clock());
  }
  mouse_move = {};
  server->flush(clock());
}

void Client::Impl::register_game_commands() {
  if (!console.find_cvar("_cl_name"))
    console.add_cvar("_cl_name", "player", "the player's name (command: name)", con::kCvarArchive);
  if (!console.find_cvar("_cl_color"))
    console.add_cvar("_cl_color", "0", "the player's colours, 16 * shirt + trousers (command: color)",
                     con::kCvarArchive);

  console.add_command("connect", "connect <name or address>[:port]: join a game on a server",
                      [this](const con::Args& args) {
                        if (args.size() != 2) {
                          log_info("connect <name or address>[:port]: join a game on a server");
                          return;
                        }
                        if (const auto status = connect_to(args[1]); !status.ok()) {
                          error = status.error();
                          console.fail_unless(status);
                        }
                      });
  console.add_command("disconnect", "disconnect: leave the game or the demo", [this](const con::Args&) {
    demo_loop_next = -1;
    next_time_demo = time_demos.size();
    end_demo(std::nullopt);
    disconnect();
  });
  console.add_command("reconnect",
                      "reconnect: sign on again for the next level; when not in a game, join the last server again",
                      [this](const con::Args&) {
                        if (demo()) return;  // as in Quake: it says itself where a level begins
                        if (link()) {
                          session.reconnect = true;
                        } else if (last_server.empty()) {
                          log_info("reconnect: there is no server to return to");
                        } else {
                          console.fail_unless(connect_to(last_server));
                        }
                      });
  console.add_command("cmd", "cmd <text>: send a command to the server", [this](const con::Args& args) {
    if (args.size() > 1) forward(args.rest());
  });
  for (const auto& [name, help] : kForwarded) {
    if (console.has_command(name)) continue;  // the server's, in the same program
    console.add_command(name, help, [this](const con::Args& args) {
      forward(args.size() > 1 ? fmt::format("{} {}", args[0], args.rest()) : args[0]);
    });
  }
  console.add_command("name", "name <name>: set your name", [this](const con::Args& args) {
    con::Cvar& name = console.cvar("_cl_name");
    if (args.size() < 2) {
      log_info("\"name\" is \"{}\"", name.string());
      return;
    }
    const std::string wanted = args.joined(1).substr(0, kMostNameBytes);
    if (wanted == name.string()) return;
    name.set(wanted);
    if (link()) forward("name " + con::in_quotes(wanted));
  });
  console.add_command("color", "color <shirt> [trousers]: set your colours, 0 to 13 each",
                      [this](const con::Args& args) {
                        con::Cvar& colors = console.cvar("_cl_color");
                        if (args.size() < 2) {
                          log_info("\"color\" is \"{} {}\"", shirt(colors.integer()), trousers(colors.integer()));
                          log_info("color <0-13> [0-13]");
                          return;
                        }
                        const auto color = [&](std::size_t i) { return std::min(args.integer(i) & 15, kMostColor); };
                        const int top = color(1), bottom = args.size() > 2 ? color(2) : top;
                        colors.set(static_cast<float>(top * 16 + bottom));
                        if (link()) forward(fmt::format("color {} {}", top, bottom));
                      });
}

}  // namespace fb::cl
