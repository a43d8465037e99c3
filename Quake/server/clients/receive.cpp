// What players say: moves, and commands as text. All of it is hostile until parsed: a message that makes no sense ends
// its sender's game, text is only what client_commands.cpp lists, and nobody from afar may say more than so much.
#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "server/clients/client_commands.h"
#include "server/clients/clients.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;

constexpr int kMostMessages = 256;     // of a player in a frame; what is more waits
constexpr double kMostOfAStall = 1.0;  // seconds: while the server did not listen, nobody could sign on

}  // namespace

void Clients::receive(double now, const std::function<void(ServerClient&)>& think) {
  const double passed = std::clamp(now - heard_at_, 0.0, kMostOfAStall);
  heard_at_ = now;
  for (auto& client : slots_) {
    if (!level_ || level_->failed()) return;
    if (!client->active()) continue;
    if (!read_messages(*client, now)) {
      drop(*client, false, now);
      continue;
    }
    if (!client->active()) continue;
    if (signs_on_too_long(*client, passed)) {
      drop(*client, false, now);
      continue;
    }
    if (!client->spawned())
      client->move = {};
    else if (!level_->failed())
      think(*client);
  }
}

// A newcomer that never signs on holds no slot. Who was in the game before may take longer for a level.
bool Clients::signs_on_too_long(ServerClient& client, double passed) {
  if (client.signed_on || client.connection->is_local()) return false;
  client.signing_on += passed;
  const double most = console_.cvar("sv_signontime").value();
  if (most <= 0.0 || client.signing_on <= most) return false;
  log_info("{} has not signed on within {} s", client.connection->address(), most);
  print(client, "You have not signed on in time.\n");
  return true;
}

// False: this player's game is over.
bool Clients::read_messages(ServerClient& client, double now) {
  for (int i = 0; i < kMostMessages && client.active(); ++i) {
    const auto message = client.connection->receive(now);
    if (!message) break;
    if (!read_message(client, message->data, now)) return false;
    if (level_->failed()) return true;
  }
  if (!client.active() || client.connection->is_open()) return true;
  log_info("{}: {}", client.name, client.connection->close_reason());
  return false;
}

bool Clients::read_message(ServerClient& client, ByteView bytes, double now) {
  net::MessageReader reader(bytes, client.name, protocol_);
  while (!reader.at_end()) {
    const auto message = net::read_client_message(reader);
    if (!message) {
      log_warning("{}", message.error().message);
      return false;
    }
    if (std::holds_alternative<net::clc::Disconnect>(*message)) return false;
    if (const auto* move = std::get_if<net::clc::Move>(&*message)) read_move(client, *move);
    if (const auto* command = std::get_if<net::clc::StringCommand>(&*message)) {
      run_client_command(*this, client, command->text, now);
      if (!client.active() || level_->failed()) return true;
    }
  }
  return true;
}

// Angles, buttons and impulse reach QuakeC at once, whether or not it is this player's turn to think.
void Clients::read_move(ServerClient& client, const net::clc::Move& move) {
  if (!client.spawned()) return;
  constexpr double kLongestPing = 10.0;  // seconds: whoever says another time than that means no harm by it
  client.ping_times[client.pings++ % ServerClient::kPings] =
      static_cast<float>(std::clamp(level_->time - move.time, 0.0, kLongestPing));
  client.move = move;
  Edict player = level_->edict(client.edict_id());
  player.set(fields::v_angle, move.view_angles);
  player.set(fields::button0, static_cast<float>(move.buttons & 1));
  player.set(fields::button2, static_cast<float>((move.buttons >> 1) & 1));
  if (move.impulse != 0) player.set(fields::impulse, static_cast<float>(move.impulse));
}

}  // namespace fb::sv
