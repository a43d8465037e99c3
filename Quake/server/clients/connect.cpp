// How players come, change levels, and go.
#include <algorithm>

#include "base/log.h"
#include "server/clients/clients.h"
#include "server/clients/signon.h"

namespace fb::sv {
namespace {

namespace globals = progs::globals;

void take_parms(ServerClient& client, const progs::Vm& vm) {
  for (std::uint32_t i = 0; i < globals::kSpawnParms; ++i) client.spawn_parms[i] = vm.get(globals::spawn_parm(i));
}

// As far as it goes without waiting for what is on its way.
void say_goodbye(ServerClient& client, double now) {
  net::MessageWriter writer = std::move(client.reliable);
  net::write_server_message(writer, net::svc::Disconnect{});
  if (writer.size() > net::kMaxMessage || !client.connection->can_send()) {
    net::MessageWriter only;
    net::write_server_message(only, net::svc::Disconnect{});
    (void)client.connection->send_unreliable(only.bytes(), now);
  } else {
    (void)client.connection->send_reliable(writer.bytes(), now);
  }
}

void refuse(net::Connection& connection, const char* why, double now) {
  net::MessageWriter writer;
  net::write_server_message(writer, net::svc::Print{why});
  net::write_server_message(writer, net::svc::Disconnect{});
  (void)connection.send_reliable(writer.bytes(), now);
  connection.close();
}

}  // namespace

ServerClient* Clients::free_slot() {
  const auto free = std::find_if(slots_.begin(), slots_.end(), [](const auto& slot) { return !slot->active(); });
  return free == slots_.end() ? nullptr : free->get();
}

void Clients::accept_new(double now) {
  for (net::Listener* listener : listeners_)
    while (auto connection = listener->accept(now)) accept(std::move(connection), now);
}

void Clients::accept(std::unique_ptr<net::Connection> connection, double now) {
  ServerClient* place = free_slot();
  if (!level_ || !place) {
    refuse(*connection, level_ ? "Server is full.\n" : "No game is running.\n", now);
    return;
  }
  log_debug("client {} connected", connection->address());
  ServerClient fresh;
  fresh.slot = place->slot;
  fresh.connection = std::move(connection);
  fresh.name = "unconnected";
  fresh.reliable = net::MessageWriter(protocol_);
  fresh.last_message = fresh.allowance_time = now;
  if (level_->loaded) fresh.spawn_parms = place->spawn_parms;  // of the save
  *place = std::move(fresh);
  if (!level_->loaded) {
    if (!level_->run(level_->vm->get(globals::SetNewParms), place->edict_id())) return;
    take_parms(*place, *level_->vm);
  }
  send_server_info(*place);
}

void Clients::send_server_info(ServerClient& client) {
  const auto crc = level_->vm->program().crc;
  print(client, fmt::format("\x02\nFULLBRIGHT SERVER ({} CRC)\n", crc));
  write_reliable(client, server_info(*level_, protocol_, max_clients()));
  const int track = progs::to_int(level_->world_edict().get(progs::fields::sounds)) & 0xff;
  write_reliable(client, net::svc::CdTrack{track, track});
  write_reliable(client, net::svc::SetView{static_cast<int>(index(client.edict_id()))});
  write_reliable(client, net::svc::SignonNum{1});
  client.stage = ServerClient::Stage::kConnected;
  client.signon = ServerClient::Signon::kFlush;
}

void Clients::save_spawn_parms() {
  if (!level_) return;
  for (auto& client : slots_) {
    if (!client->active()) continue;
    if (!level_->run(level_->vm->get(globals::SetChangeParms), client->edict_id())) return;
    take_parms(*client, *level_->vm);
  }
}

void Clients::send_reconnect(double now) {
  net::MessageWriter writer;
  net::write_server_message(writer, net::svc::StuffText{"reconnect\n"});
  for (auto& client : slots_) {
    if (!client->active()) continue;
    client->before_it.push_back(writer.bytes());
    send_reliable(*client, now);
  }
}

void Clients::drop(ServerClient& client, bool crashed, double now) {
  if (!client.active()) return;
  if (!crashed) {
    say_goodbye(client, now);
    if (level_ && client.stage >= ServerClient::Stage::kInLevel) {
      progs::Vm& vm = *level_->vm;
      const EdictId self = vm.get(globals::self);
      (void)level_->run(vm.get(globals::ClientDisconnect), client.edict_id());
      vm.set(globals::self, self);
    }
  }
  // Who has not come into the game has no name yet, nor was anybody told of its coming.
  if (client.stage >= ServerClient::Stage::kInLevel)
    log_info("{} has left ({})", client.name, client.connection->address());
  else
    log_debug("client {} is gone", client.connection->address());
  client.connection->close();
  ServerClient gone;
  gone.slot = client.slot;
  gone.reliable = net::MessageWriter(protocol_);
  client = std::move(gone);
  for (auto& other : slots_) {
    if (!other->active()) continue;
    write_reliable(*other, net::svc::UpdateName{client.slot, ""});
    write_reliable(*other, net::svc::UpdateFrags{client.slot, 0});
    write_reliable(*other, net::svc::UpdateColors{client.slot, 0});
  }
}

void Clients::drop_all(double now) {
  for (auto& client : slots_) {
    if (!client->active()) continue;
    say_goodbye(*client, now);
    drop(*client, true, now);
  }
}

net::ServerStatus Clients::status(double now) {
  net::ServerStatus status;
  status.name = console_.cvar("hostname").string();
  status.map = level_ ? level_->map_name : "";
  status.max_players = max_clients();
  for (const auto& client : slots_)
    if (client->active())
      status.players.push_back(
          {client->name, client->colors, client->old_frags, now - client->connection->connect_time()});
  for (const char* rule : {"coop", "deathmatch", "fraglimit", "noexit", "pausable", "samelevel", "skill", "sv_gravity",
                           "sv_maxspeed", "teamplay", "timelimit"})
    if (const con::Cvar* cvar = console_.find_cvar(rule)) status.rules.emplace_back(cvar->name(), cvar->string());
  return status;
}

}  // namespace fb::sv
