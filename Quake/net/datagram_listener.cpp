#include "net/datagram_listener.h"

#include <algorithm>

#include "net/server_messages.h"

namespace fb::net {
namespace {

constexpr int kMostRequestsACall = 512;  // so that a flood cannot delay the frame
constexpr double kPause = 1.0;           // seconds between two calls, in which silence is one's own deafness
constexpr double kMayBeGone = 1.0;       // seconds of silence before which nobody can be back from a crash
constexpr const char* kFull = "Server is full.\n";
constexpr const char* kTooMany = "Too many players of your address are here.\n";

std::string cut(const std::string& text, std::size_t most) { return text.substr(0, most); }
int to_byte(std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, 255)); }

// The rule after the named one, the first for an empty name; nothing if there is no such rule. Rules whose names would
// not fit a reply are skipped; an empty name ends the list.
std::optional<ccrep::RuleInfo> rule_after(const ServerStatus& status, const std::string& previous, std::size_t room) {
  auto rule = status.rules.begin();
  if (!previous.empty()) {
    rule = std::ranges::find(status.rules, previous, &std::pair<std::string, std::string>::first);
    if (rule == status.rules.end()) return std::nullopt;
    ++rule;
  }
  rule = std::find_if(rule, status.rules.end(), [&](const auto& r) { return r.first.size() <= room; });
  if (rule == status.rules.end()) return ccrep::RuleInfo{};
  return ccrep::RuleInfo{rule->first, cut(rule->second, room - rule->first.size())};
}

// In words, as far as one packet tells.
void refuse(DatagramConnection& connection, const char* why, double now) {
  MessageWriter writer;
  write_server_message(writer, svc::Print{why});
  write_server_message(writer, svc::Disconnect{});
  if (connection.can_send())
    (void)connection.send_reliable(writer.bytes(), now);
  else
    (void)connection.send_unreliable(writer.bytes(), now);
  connection.close();
}

}  // namespace

Result<std::unique_ptr<DatagramListener>> DatagramListener::open(Network& network, std::uint16_t port,
                                                                 StatusSource status, std::uint64_t seed) {
  std::vector<std::unique_ptr<Socket>> sockets;
  auto v4 = network.open(Family::kIpv4, port);
  if (v4) sockets.push_back(std::move(*v4));
  // Opens both address families on the same port, also if any port is allowed.
  auto v6 = network.open(Family::kIpv6, v4 ? sockets.front()->port() : port);
  if (v6) sockets.push_back(std::move(*v6));
  if (sockets.empty()) return v4.error();
  return std::unique_ptr<DatagramListener>(new DatagramListener(network, std::move(sockets), std::move(status), seed));
}

DatagramListener::DatagramListener(Network& network, std::vector<std::unique_ptr<Socket>> sockets, StatusSource status,
                                   std::uint64_t seed)
    : network_(network), sockets_(std::move(sockets)), status_(std::move(status)), limit_(seed) {}

DatagramListener::~DatagramListener() = default;

std::unique_ptr<Connection> DatagramListener::accept(double now) {
  if (now - polled_ > kPause) awake_since_ = now;
  polled_ = now;
  for (const auto& socket : sockets_) read_requests(*socket, now);
  take_proven(now);
  return hand_out(now);
}

void DatagramListener::read_requests(Socket& socket, double now) {
  for (int i = 0; i < kMostRequestsACall; ++i) {
    const auto datagram = socket.receive_from();
    if (!datagram) return;
    const auto request = parse_control_request(datagram->data);
    if (request && limit_.allow(datagram->from, now))
      answer_request(socket, datagram->from, datagram->data.size(), *request, now);
  }
}

void DatagramListener::answer(Socket& socket, const Address& to, std::size_t request_size, const ControlReply& reply) {
  const Bytes bytes = write_control(reply);
  if (bytes.size() <= kMostReply * request_size) socket.send_to(to, bytes);
}

void DatagramListener::answer_request(Socket& socket, const Address& from, std::size_t size,
                                      const ControlRequest& request, double now) {
  // Room for text in a reply, after its numbers, headers and terminating zeros.
  const auto room = [&](std::size_t fixed) { return kMostReply * size - fixed; };
  if (const auto* connect = std::get_if<ccreq::Connect>(&request)) {
    if (connect->game == kGameName) answer_connect(socket, from, size, *connect, now);
  } else if (const auto* info = std::get_if<ccreq::ServerInfo>(&request)) {
    if (info->game != kGameName) return;
    const ServerStatus status = status_();
    const std::size_t each = room(kControlHeader + 1 + 3 + 3) / 2;
    answer(socket, from, size,
           ccrep::ServerInfo{"", cut(status.name, each), cut(status.map, each), to_byte(status.players.size()),
                             std::clamp(status.max_players, 0, 255), kConnectVersion});
  } else if (const auto* player = std::get_if<ccreq::PlayerInfo>(&request)) {
    const ServerStatus status = status_();
    const auto index = static_cast<std::size_t>(player->player);
    if (index >= status.players.size()) return;
    const PlayerStatus& p = status.players[index];
    answer(socket, from, size,
           ccrep::PlayerInfo{player->player, cut(p.name, room(kControlHeader + 2 + 12 + 2)), p.colors, p.frags,
                             static_cast<std::int32_t>(std::clamp(p.seconds, 0.0, 1e9)), ""});
  } else if (const auto* rule = std::get_if<ccreq::RuleInfo>(&request)) {
    if (const auto reply = rule_after(status_(), rule->previous, room(kControlHeader + 1 + 2)))
      answer(socket, from, size, *reply);
  }
}

void DatagramListener::answer_connect(Socket& socket, const Address& from, std::size_t size,
                                      const ccreq::Connect& request, double now) {
  if (request.version != kConnectVersion) return answer(socket, from, size, ccrep::Reject{"Incompatible version.\n"});
  const auto accept = [&](const DatagramConnection& connection) {
    answer(socket, from, size, ccrep::Accept{connection.local_port()});
  };
  for (const auto& pending : pending_)
    if (pending->peer()->address == from) return accept(*pending);
  for (const Newcomer& newcomer : waiting_)
    if (newcomer.address() == from) return accept(*newcomer.connection);
  forget_closed();
  for (const auto& peer : connected_)  // a request that was late, or repeated on its way
    if (peer->address == from && silence(*peer, now) < kMayBeGone) return;
  const ServerStatus status = status_();
  if (static_cast<int>(status.players.size()) >= status.max_players) {
    const auto old = most_silent(from, now);
    if (!old || silence(*old, now) < kMayBeGone) return answer(socket, from, size, ccrep::Reject{kFull});
  }
  make_room_for_pending();
  auto own = network_.open(from.family, 0);
  if (!own) return;
  pending_.push_back(std::make_unique<DatagramConnection>(std::move(*own), from, now, timeout_));
  pending_.back()->doubt_peer();
  accept(*pending_.back());
}

// Whoever asks in the name of one host a thousand times takes the place of that host alone.
void DatagramListener::make_room_for_pending() {
  if (pending_.size() < kMostPending) return;
  const auto of_same_site = [this](const auto& pending) {
    return std::ranges::count_if(
        pending_, [&](const auto& other) { return other->peer()->address.same_site(pending->peer()->address); });
  };
  pending_.erase(std::ranges::max_element(pending_, {}, of_same_site));  // the first, and so the oldest, of equals
}

void DatagramListener::forget_closed() {
  std::erase_if(connected_, [](const auto& peer) { return !peer->open; });
}

// What was said while nobody listened here has not been read yet.
double DatagramListener::silence(const Peer& peer, double now) const {
  return now - std::max(peer.last_heard, awake_since_);
}

std::shared_ptr<DatagramListener::Peer> DatagramListener::most_silent(const Address& host, double now) const {
  std::shared_ptr<Peer> most;
  for (const auto& peer : connected_)
    if (peer->open && peer->address.same_host(host) && (!most || silence(*peer, now) > silence(*most, now)))
      most = peer;
  return most;
}

// Those whose address is proven by now wait for a slot from here on.
void DatagramListener::take_proven(double now) {
  for (auto& pending : pending_) {
    if (!pending->poll_peer(now)) continue;
    const Address& from = pending->peer()->address;
    const auto of_host = static_cast<std::size_t>(
        std::ranges::count_if(waiting_, [&](const Newcomer& other) { return other.address().same_site(from); }));
    if (waiting_.size() < kMostWaiting && of_host < kMostWaitingOfHost)
      waiting_.push_back({std::move(pending), now});
    else
      refuse(*pending, kFull, now);
  }
  std::erase_if(pending_, [](const auto& pending) { return !pending || !pending->is_open(); });
}

std::unique_ptr<Connection> DatagramListener::hand_out(double now) {
  if (waiting_.empty()) return nullptr;
  forget_closed();
  const ServerStatus status = status_();
  std::unique_ptr<DatagramConnection> taken;
  for (Newcomer& newcomer : waiting_) {
    newcomer.connection->poll_peer(now);
    switch (judge(newcomer, status, now)) {
      case Verdict::kComesIn:
        taken = std::move(newcomer.connection);
        break;
      case Verdict::kWaits:
        break;
      case Verdict::kNoRoom:
        refuse(*newcomer.connection, kFull, now);
        break;
      case Verdict::kTooManyOfHost:
        refuse(*newcomer.connection, kTooMany, now);
        break;
    }
    if (taken) break;
  }
  std::erase_if(waiting_, [](const Newcomer& one) { return !one.connection || !one.connection->is_open(); });
  if (taken) connected_.push_back(taken->peer());
  return taken;
}

DatagramListener::Verdict DatagramListener::judge(Newcomer& newcomer, const ServerStatus& status, double now) {
  const Address& from = newcomer.address();
  const auto replace = [&](Peer& old) {
    old.open = false;
    old.close_reason = "connected anew";
    newcomer.replaces = true;
  };
  for (const auto& peer : connected_)
    if (peer->open && peer->address == from) replace(*peer);
  const auto old = most_silent(from, now);
  if (!newcomer.replaces && old && silence(*old, now) > kSilent) replace(*old);

  int of_host = 0, signing_on = 0, promised = 0;
  for (const auto& peer : connected_) {
    if (!peer->open || !peer->address.same_site(from)) continue;
    ++of_host;
    if (!peer->signed_on) ++signing_on;
  }
  for (const Newcomer& other : waiting_)
    if (other.replaces && &other != &newcomer) ++promised;
  const int taken = static_cast<int>(status.players.size()) + (newcomer.replaces ? 0 : promised);
  const bool room = taken < status.max_players;
  const bool host_has_room = most_per_host_ == 0 || of_host < most_per_host_;
  const bool may_sign_on = signing_on < std::max(2, (status.max_players + 1) / 2);
  if (room && host_has_room && may_sign_on) return Verdict::kComesIn;
  // One that has said nothing since may have gone.
  const bool may_replace = newcomer.replaces || (old && old->last_heard <= newcomer.since);
  if (now - newcomer.since < kLongestWait && (may_replace || (room && host_has_room))) return Verdict::kWaits;
  return host_has_room ? Verdict::kNoRoom : Verdict::kTooManyOfHost;
}

}  // namespace fb::net
