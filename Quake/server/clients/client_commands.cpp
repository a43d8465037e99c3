#include "server/clients/client_commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "server/clients/cheats.h"
#include "server/clients/client_data.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
namespace globals = progs::globals;
using progs::to_int;
using Stage = ServerClient::Stage;

constexpr std::size_t kMostName = 15;   // letters
constexpr std::size_t kMostText = 400;  // letters of a say
constexpr int kMostColor = 13;          // of the palette's rows; the last two glow

// Commands from afar: so many at once, and so many a second.
constexpr double kBurst = 60.0, kPerSecond = 15.0, kForgiven = 30.0;

// Text of one line: line breaks would let players speak as others do, and 1 to 3 at the beginning colour a print and
// make a sound.
std::string one_line(std::string_view text, std::size_t most) {
  std::string line;
  for (const char c : text.substr(0, most))
    if (c != '\n' && c != '\r' && !(c >= 1 && c <= 3)) line.push_back(c);
  return line;
}

// What follows the command, without the quotes around it.
std::string spoken(std::string_view text) {
  if (!text.empty() && text.front() == '"') {
    text.remove_prefix(1);
    if (!text.empty() && text.back() == '"') text.remove_suffix(1);
  }
  return one_line(text, kMostText);
}

std::string name_list(Clients& clients) {
  std::string names;
  for (int i = 0; i < clients.max_clients(); ++i)
    if (clients[i].active())
      names += fmt::format("{:4} {}\n", to_int(clients[i].average_ping() * 1000.0f), clients[i].name);
  return names;
}

// "name" or "# number"; null for nobody. `rest`: what follows, from word `rest` on.
ServerClient* find_player(Clients& clients, const con::Args& args, std::size_t& rest) {
  const bool by_number = args[1] == "#" && args.size() > 2;
  rest = by_number ? 3 : 2;
  if (by_number) {
    const int slot = args.integer(2) - 1;
    return slot >= 0 && slot < clients.max_clients() && clients[slot].active() ? &clients[slot] : nullptr;
  }
  for (int i = 0; i < clients.max_clients(); ++i)
    if (clients[i].active() && con::same_name(clients[i].name, args[1])) return &clients[i];
  return nullptr;
}

void kick(Clients& clients, const con::Args& args, const ServerClient* who, std::string_view by, double now) {
  std::size_t rest = 0;
  ServerClient* kicked = find_player(clients, args, rest);
  if (!kicked || kicked == who) return;
  const std::string why = one_line(args.joined(rest), kMostText);
  clients.print(*kicked, why.empty() ? fmt::format("Kicked by {}\n", by) : fmt::format("Kicked by {}: {}\n", by, why));
  clients.drop(*kicked, false, now);
}

}  // namespace

std::string status_text(Clients& clients, bool with_addresses, double now) {
  const net::ServerStatus status = clients.status(now);
  std::string text = fmt::format("host:    {}\nmap:     {}\nplayers: {} active ({} max)\n\n", status.name, status.map,
                                 status.players.size(), status.max_players);
  for (int i = 0; i < clients.max_clients(); ++i) {
    const ServerClient& client = clients[i];
    if (!client.active()) continue;
    const auto seconds = std::max(0, to_int(now - client.connection->connect_time()));
    text += fmt::format("#{:<2} {:<16.16}  {:3}  {:2}:{:02}:{:02}\n", i + 1, client.name, client.old_frags,
                        seconds / 3600, seconds / 60 % 60, seconds % 60);
    if (with_addresses) text += fmt::format("   {}\n", client.connection->address());
  }
  return text;
}

// One command of one player.
struct ClientCommands {
  Clients& all;
  ServerClient& client;
  Level& level;
  const con::Args& args;
  double now;

  Edict edict() const { return level.edict(client.edict_id()); }
  bool is_local() const { return client.connection->is_local(); }

  // --- on the way in ---
  void prespawn() {
    if (client.stage > Stage::kPrespawned) return;
    client.stage = Stage::kPrespawned;
    client.signon = ServerClient::Signon::kParts;
    client.next_part = 0;
  }
  void spawn() {
    if (client.stage != Stage::kPrespawned) return;
    if (level.loaded)
      level.paused = false;  // was so until somebody comes; the edict is as it was saved
    else if (!enter())
      return;
    forget_what_was_said();
    tell_state();
    client.stage = Stage::kInLevel;
    client.signon = ServerClient::Signon::kFlush;
  }
  void begin() {
    if (client.stage != Stage::kInLevel) return;
    client.stage = Stage::kPlaying;
    client.signed_on = true;
    client.connection->set_signed_on();
  }

  // QuakeC's ClientConnect and PutClientInServer, on an empty edict.
  bool enter() {
    Edict player = edict();
    std::fill_n(player.words(), level.edicts().words_per_edict(), progs::Word{0});
    player.set(fields::colormap, static_cast<float>(index(client.edict_id())));
    player.set(fields::team, static_cast<float>((client.colors & 15) + 1));
    player.set(fields::netname, level.vm->strings().intern(client.name));
    for (std::uint32_t i = 0; i < globals::kSpawnParms; ++i)
      level.vm->set(globals::spawn_parm(i), client.spawn_parms[i]);
    if (!level.run(level.vm->get(globals::ClientConnect), client.edict_id())) return false;
    const bool fresh = now - client.connection->connect_time() <= level.time;
    if (fresh && (is_local() || !all.heard_here()))
      log_info("{} entered the game", client.name);  // else QuakeC says so
    return level.run(level.vm->get(globals::PutClientInServer), client.edict_id());
  }
  // What QuakeC has said to a player in ClientConnect and PutClientInServer is lost, as in Quake (SZ_Clear in
  // Host_Spawn_f): mods repeat a second later what matters (Misc/QUIRKS.md).
  void forget_what_was_said() { client.reliable.truncate(0); }
  // How everything stands that is told of by its changes.
  void tell_state() {
    const auto say = [&](const net::ServerMessage& message) { net::write_server_message(client.reliable, message); };
    say(net::svc::Time{static_cast<float>(level.time)});
    for (int i = 0; i < all.max_clients(); ++i) {
      const ServerClient& other = all[i];
      say(net::svc::UpdateName{i, other.name});
      say(net::svc::UpdateFrags{i, other.old_frags});
      say(net::svc::UpdateColors{i, other.colors});
    }
    for (std::size_t i = 0; i < level.light_styles.size(); ++i)
      say(net::svc::LightStyle{static_cast<int>(i), level.light_styles[i]});
    const auto say_stat = [&](int stat, progs::Global<float> value) {
      say(net::svc::UpdateStat{stat, to_int(level.vm->get(value))});
    };
    say_stat(net::kStatTotalSecrets, globals::total_secrets);
    say_stat(net::kStatTotalMonsters, globals::total_monsters);
    say_stat(net::kStatSecrets, globals::found_secrets);
    say_stat(net::kStatMonsters, globals::killed_monsters);
    // Without roll: a save may have caught the view tilted, and nothing would right it.
    const vec3 angles = edict().get(fields::angles);
    say(net::svc::SetAngle{vec3(angles.x, angles.y, 0.0f)});
    write_client_data(client.reliable, level, client.edict_id(), all.standard_quake);
    say(net::svc::SignonNum{3});
  }

  // --- who one is ---
  void name() {
    if (args.size() < 2) return;
    std::string name = one_line(args.size() == 2 ? args[1] : args.rest(), kMostName);
    if (name.empty()) name = "unnamed";
    if (client.name != name && client.stage >= Stage::kInLevel) log_info("{} renamed to {}", client.name, name);
    client.name = name;
    edict().set(fields::netname, level.vm->strings().intern(name));
    all.write_to_all(net::svc::UpdateName{client.slot, name});
  }
  void color() {
    if (args.size() < 2) return;
    const int top = std::min(args.integer(1) & 15, kMostColor);
    const int bottom = args.size() == 2 ? top : std::min(args.integer(2) & 15, kMostColor);
    client.colors = top * 16 + bottom;
    edict().set(fields::team, static_cast<float>(bottom + 1));
    all.write_to_all(net::svc::UpdateColors{client.slot, client.colors});
  }

  // --- talk ---
  void say_to(bool team_only) {
    if (args.size() < 2) return;
    const std::string text = fmt::format("\x01{}: {}\n", client.name, spoken(args.rest()));
    const float team = edict().get(fields::team);
    for (int i = 0; i < all.max_clients(); ++i) {
      ServerClient& other = all[i];
      if (!other.active() || !other.spawned()) continue;
      if (team_only && level.cvars.teamplay.on() && level.edict(other.edict_id()).get(fields::team) != team) continue;
      all.print(other, text);
    }
    if (!all.heard_here()) log_info("{}", std::string_view(text).substr(1, text.size() - 2));
  }
  void say() { say_to(false); }
  void say_team() { say_to(true); }
  void tell() {
    if (args.size() < 3) return;
    std::size_t rest = 0;
    if (ServerClient* other = find_player(all, args, rest); other && other->spawned())
      all.print(*other, fmt::format("{}: {}\n", client.name, one_line(args.joined(rest), kMostText)));
  }
  void ping() { all.print(client, "Client ping times:\n" + name_list(all)); }
  void status() { all.print(client, status_text(all, is_local(), now)); }

  // --- what changes the game ---
  void kill() {
    if (edict().get(fields::health) <= 0.0f)
      all.print(client, "Can't suicide -- already dead!\n");
    else
      level.run(level.vm->get(globals::ClientKill), client.edict_id());
  }
  void pause() {
    if (!level.cvars.pausable.on()) return all.print(client, "Pause not allowed.\n");
    all.broadcast_print(fmt::format("{} {} the game\n", client.name, level.paused ? "unpaused" : "paused"));
    all.set_pause(!level.paused);
  }
  // QuakeSpasm lets every player of a cooperative game throw out others; here it takes the host.
  void kick_other() {
    if (is_local()) kick(all, args, &client, client.name, now);
  }
  void cheat(Cheat cheat) {
    if (level.vm->get(globals::deathmatch) != 0.0f) return;
    const std::string said = cheat({level, client.edict_id(), args, !all.standard_quake});
    if (!said.empty()) all.print(client, said);
  }
};

namespace {

struct Row {
  std::string_view name;
  Stage from;  // ignored before
  double cost;
  void (ClientCommands::*run)();
};
constexpr Row kCommands[] = {
    {"prespawn", Stage::kConnected, 1.0, &ClientCommands::prespawn},
    {"spawn", Stage::kConnected, 1.0, &ClientCommands::spawn},
    {"begin", Stage::kConnected, 1.0, &ClientCommands::begin},
    {"name", Stage::kConnected, 8.0, &ClientCommands::name},
    {"color", Stage::kConnected, 4.0, &ClientCommands::color},
    {"status", Stage::kConnected, 4.0, &ClientCommands::status},
    {"ping", Stage::kConnected, 4.0, &ClientCommands::ping},
    {"say", Stage::kPlaying, 8.0, &ClientCommands::say},
    {"say_team", Stage::kPlaying, 8.0, &ClientCommands::say_team},
    {"tell", Stage::kPlaying, 8.0, &ClientCommands::tell},
    {"kill", Stage::kPlaying, 1.0, &ClientCommands::kill},
    {"pause", Stage::kPlaying, 8.0, &ClientCommands::pause},
    {"kick", Stage::kPlaying, 1.0, &ClientCommands::kick_other},
};

// Whether the player may say something of this cost now.
bool pay(Clients& clients, ServerClient& client, double cost, double now) {
  if (client.connection->is_local()) return true;
  client.command_allowance = std::min(kBurst, client.command_allowance + (now - client.allowance_time) * kPerSecond);
  client.allowance_time = now;
  if (client.command_allowance > kForgiven) client.flood_told = false;
  if (client.command_allowance >= cost && !client.flood_told) {
    client.command_allowance -= cost;
    return true;
  }
  if (!client.flood_told) {
    client.flood_told = true;
    log_info("{} sends commands too fast", client.name);
    clients.print(client, "You send commands too fast: wait a few seconds.\n");
  }
  return false;
}

const Row* find_command(std::string_view name) {
  const auto* row = std::find_if(std::begin(kCommands), std::end(kCommands),
                                 [&](const Row& known) { return con::same_name(known.name, name); });
  return row == std::end(kCommands) ? nullptr : row;
}

// Until the text's first zero.
std::string_view whole_text(std::string_view text) { return text.substr(0, text.find('\0')); }

// KRIMZON_SV_PARSECLIENTCOMMAND: what players in the game say goes to the mod, where it wants to hear; it hands on what
// it leaves to the engine (clientcommand). False: it does not want to.
bool tell_mod(const Clients& clients, const ServerClient& client, Level& level, std::string_view text) {
  if (!client.spawned() || !clients.extensions_wanted()) return false;
  progs::Vm& vm = *level.vm;
  const FunctionId parse = vm.program().find_function("SV_ParseClientCommand");
  if (parse == FunctionId::kNull) return false;
  vm.set_parm(0, vm.strings().temporary(text));
  level.run(parse, client.edict_id());
  return true;
}

}  // namespace

void run_client_command(Clients& clients, ServerClient& client, std::string_view text, double now) {
  const con::Args args(whole_text(text));
  const Row* row = find_command(args[0]);
  if (!pay(clients, client, row ? row->cost : 1.0, now)) return;
  if (!tell_mod(clients, client, *clients.level(), whole_text(text))) clients.execute_command(client, text);
}

void Clients::execute_command(ServerClient& client, std::string_view text) {
  const con::Args args(whole_text(text));
  ClientCommands commands{*this, client, *level_, args, heard_at_};
  if (const Row* row = find_command(args[0])) {
    if (client.stage >= row->from) (commands.*row->run)();
  } else if (const Cheat cheat = find_cheat(args[0])) {
    if (client.spawned()) commands.cheat(cheat);
  } else {
    log_debug("{} tried to {}", client.name, one_line(text, kMostText));
  }
}

bool Clients::console_command(const con::Args& args, double now) {
  if (con::same_name(args[0], "status")) {
    log_info("{}", status_text(*this, true, now));
  } else if (con::same_name(args[0], "ping")) {
    log_info("Client ping times:\n{}", name_list(*this));
  } else if (con::same_name(args[0], "kick")) {
    kick(*this, args, nullptr, "Console", now);
  } else if (con::same_name(args[0], "say")) {
    if (args.size() > 1)
      broadcast_print(fmt::format("\x01<{}> {}\n", console_.cvar("hostname").string(), spoken(args.rest())));
  } else {
    return false;
  }
  return true;
}

}  // namespace fb::sv
