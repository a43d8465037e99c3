// A frame's messages to each player: the datagram of who plays, the next stage of who is on the way in.
#include <algorithm>

#include "base/log.h"
#include "server/clients/client_data.h"
#include "server/clients/clients.h"
#include "server/clients/send_entities.h"
#include "server/clients/split_messages.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
using progs::to_int;

constexpr double kKeepAlive = 5.0;  // seconds without a word on the way in
constexpr std::int32_t kMuzzleFlash = 2;

// The longest unreliable message that clients of the protocol take whole: NetQuake's datagram over a network, and its
// buffer for any message within the program; QuakeSpasm's for the others.
std::size_t datagram_limit(const net::Protocol& protocol, const net::Connection& connection) {
  const std::size_t most = protocol.extended() ? net::kMaxMessage : connection.is_local() ? 8000 : 1024;
  return std::min(most, connection.unreliable_limit());
}

// The signon is cut into parts of this length, such that NetQuake's clients (8,000 bytes) and FitzQuake's (32,000) take
// a part, what gathered before it and the signon number in one message.
std::size_t signon_part_limit(const net::Protocol& protocol) { return protocol.extended() ? 31500 : 7500; }

}  // namespace

void Clients::send(double now) {
  if (!level_) return;
  update_frags();
  for (auto& client : slots_) {
    if (client->sent_away) drop(*client, false, now);
    if (!client->active()) continue;
    if (client->spawned()) {
      if (!send_datagram(*client, now)) continue;
    } else {
      send_signon(*client, now);
    }
    if (client->active()) send_reliable(*client, now);
  }
  datagram_.truncate(0);
  for (std::uint32_t i = 1; i < level_->edicts().count(); ++i) {
    Edict edict = level_->edict(EdictId{i});
    if (edict.has_flag(fields::effects, kMuzzleFlash)) edict.remove_flag(fields::effects, kMuzzleFlash);
  }
}

// What goes to all joins what goes to each.
void Clients::update_frags() {
  for (auto& client : slots_) {
    const int frags = to_int(level_->edict(client->edict_id()).get(fields::frags));
    if (frags == client->old_frags) continue;
    client->old_frags = frags;
    write_to_all(net::svc::UpdateFrags{client->slot, frags});
  }
  if (reliable_datagram_.size() > kMostBytes) {
    log_warning("more is said to all in a frame than a message holds ({} bytes): the rest is lost", kMostBytes);
    reliable_datagram_.truncate(whole_messages(reliable_datagram_.bytes(), kMostBytes, protocol_));
  }
  for (auto& client : slots_)
    if (client->active()) client->reliable.append(reliable_datagram_.bytes());
  reliable_datagram_.truncate(0);
}

bool Clients::send_datagram(ServerClient& client, double now) {
  const std::size_t limit = datagram_limit(protocol_, *client.connection);
  net::MessageWriter writer(protocol_);
  net::write_server_message(writer, net::svc::Time{static_cast<float>(level_->time)});
  write_client_data(writer, *level_, client.edict_id(), standard_quake);
  // Sounds and effects happen once, things are told of again: a quarter is theirs, if they need it.
  const std::size_t room = limit - std::min(limit, writer.size());
  const std::size_t reserved = std::min(datagram_.size(), room / 4);
  if (!write_entities(writer, *level_, client.edict_id(), room - reserved, effects_mask_) && !told_full_) {
    told_full_ = true;
    log_warning("{} sees more than a message of {} bytes holds: what is far away is left out", client.name, limit);
  }
  const std::size_t rest = limit - std::min(limit, writer.size());
  writer.append(ByteView(datagram_.bytes()).first(whole_messages(datagram_.bytes(), rest, protocol_)));
  if (client.connection->send_unreliable(writer.bytes(), now)) return true;
  if (client.connection->is_open()) return true;  // it is lost, as unreliable messages may be
  drop(client, true, now);
  return false;
}

void Clients::send_signon(ServerClient& client, double now) {
  using Signon = ServerClient::Signon;
  if (client.signon == Signon::kWaiting && now - client.last_message > kKeepAlive) {
    net::MessageWriter nop;
    net::write_server_message(nop, net::svc::Nop{});
    (void)client.connection->send_unreliable(nop.bytes(), now);
    client.last_message = now;
  }
  if (client.signon != Signon::kParts || !client.before_it.empty() || !client.connection->can_send()) return;
  const std::vector<Bytes>& parts = signon_parts();
  if (client.next_part < parts.size()) client.reliable.append(parts[client.next_part++]);
  if (client.next_part < parts.size()) return;
  net::write_server_message(client.reliable, net::svc::SignonNum{2});
  client.signon = Signon::kFlush;
}

const std::vector<Bytes>& Clients::signon_parts() {
  if (signon_parts_of_ == signon_.size()) return signon_parts_;
  signon_parts_of_ = signon_.size();
  signon_parts_ = split_messages(signon_.bytes(), signon_part_limit(protocol_), protocol_);
  return signon_parts_;
}

void Clients::send_reliable(ServerClient& client, double now) {
  using Signon = ServerClient::Signon;
  net::Connection& connection = *client.connection;
  if (client.overflowed || client.reliable.size() > kMostBytes) {
    log_warning("{} has not taken the {} bytes that wait for it: it is dropped", client.name, client.reliable.size());
    drop(client, true, now);
    return;
  }
  if (!connection.is_open()) return;  // receive() will notice
  if (!connection.can_send()) return;
  if (!client.before_it.empty()) {
    (void)connection.send_reliable(client.before_it.front(), now);
    client.before_it.pop_front();
    client.last_message = now;
    return;
  }
  const bool asked_for = client.spawned() || client.signon != Signon::kWaiting;
  if (!asked_for || client.reliable.size() == 0) return;
  (void)connection.send_reliable(client.reliable.bytes(), now);
  client.reliable.truncate(0);
  client.last_message = now;
  if (client.signon == Signon::kFlush) client.signon = Signon::kWaiting;
}

}  // namespace fb::sv
